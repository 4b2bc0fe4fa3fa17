{% from "function.mo" import function %}
within PyImu.Effects;
package {{ name }} "{{ effect.term | capital | text }}"
  extends PyImu.Icons.EffectPackage;
{% for f in functions %}

{{ function(f) -}}
{% endfor %}

  block {{ first.name }} "{{ first.description | text }}"
    extends PyImu.Interfaces.SampledEffect(x(each unit="{{ first.unit }}"), y(each unit="{{ first.unit }}"));
{% for line in first.declarations %}
    {{ line }}
{% endfor %}
{% if first.states %}
  protected
{% for line in first.states %}
    {{ line }}
{% endfor %}
{% endif %}
  equation
{% for line in first.asserts %}
    {{ line }}
{% endfor %}
    when sample(samplePeriod, samplePeriod) then
{% for line in first.equations %}
      {{ line }}
{% endfor %}
    end when;
  end {{ first.name }};
{% for block in others %}

{% set line = "block " ~ block.name ~ " = " ~ first.name ~ "(" ~ block.modifications ~ ")" ~ block.description | comment ~ ";" %}
  {{ line | folded(2) }}
{% endfor %}
{% if continuous %}

  block {{ first.name }}Continuous "{{ first.description | text }}, without samples"
    extends PyImu.Interfaces.ContinuousEffect(x(each unit="{{ first.unit }}"), y(each unit="{{ first.unit }}"));
{% for line in first.declarations %}
    {{ line }}
{% endfor %}
  equation
{% for line in first.asserts %}
    {{ line }}
{% endfor %}
    y = {{ continuous }};
  end {{ first.name }}Continuous;
{% for block in others %}

{% set line = "block " ~ block.name ~ "Continuous = " ~ first.name ~ "Continuous(" ~ block.modifications ~ ")" ~ (block.description ~ ", without samples") | comment ~ ";" %}
  {{ line | folded(2) }}
{% endfor %}
{% endif %}

  annotation(Documentation(info="<html>
{{ documentation | page }}
</html>"));
end {{ name }};
