within {{ within }};
package {{ name }} "{{ description | text }}"
  extends Modelica.Icons.Package;
{% for lines in own %}

{% for line in lines %}
  {{ line }}
{% endfor %}
{% endfor %}
{% for triad in triads %}

  block {{ triad.name }} "{{ triad.description | text }}"
    extends PyImu.Interfaces.Triad(samplePeriod={{ period }});
    parameter Real y0[3] = {{ triad.start }} "Output before the first sample";
{% for line in triad.declarations %}
    {{ line }}
{% endfor %}
  equation
{% for line in triad.connections %}
    {{ line }}
{% endfor %}
  end {{ triad.name }};
{% endfor %}

  block Imu "{{ description | text }}"
    extends PyImu.Interfaces.Imu(samplePeriod={{ period }});
{% for line in connectors %}
    {{ line }}
{% endfor %}
    Gyroscope gyroscope(samplePeriod=samplePeriod, seed=seed)
      annotation(Placement(transformation(extent={{ "{{-20,30},{20,70}}" }})));
    Accelerometer accelerometer(samplePeriod=samplePeriod, seed=seed)
      annotation(Placement(transformation(extent={{ "{{-20,-70},{20,-30}}" }})));
  equation
{% for line in connections %}
    {{ line }}
{% endfor %}
    when sample(samplePeriod, samplePeriod) then
      measuredTemperature = temperature;
    end when;
  end Imu;

  annotation({% if uses %}uses(PyImu(version="{{ version }}"), Modelica(version="4.0.0")), {% endif %}Documentation(info="<html>
{{ documentation | page }}
</html>"));
end {{ name }};
