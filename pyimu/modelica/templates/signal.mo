{% from "function.mo" import function %}
within PyImu.Signals;
package {{ name }} "{{ description | capital | text }}"
  extends PyImu.Icons.SignalPackage;
{% for f in functions %}

{{ function(f) -}}
{% endfor %}

  block Signal "{{ description | capital | text }}"
    extends PyImu.Interfaces.Sampled;
{% for line in declarations %}
    {{ line }}
{% endfor %}
{% if states %}
  protected
{% for line in states %}
    {{ line }}
{% endfor %}
{% endif %}
  equation
    when sample(samplePeriod, samplePeriod) then
{% for line in equations %}
      {{ line }}
{% endfor %}
    end when;
  end Signal;

  annotation(Documentation(info="<html>
{{ documentation | page }}
</html>"));
end {{ name }};
