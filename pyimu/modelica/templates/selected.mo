within PyImu.Sensors;
block {{ name }} "{{ description | text }}"
  extends PyImu.Interfaces.{{ interface }}(samplePeriod=partPeriods[part]);
  parameter PyImu.Sensors.Part part = PyImu.Sensors.Part.{{ default }} "Which part"
    annotation(Evaluate=true);
  constant Modelica.Units.SI.Time partPeriods[PyImu.Sensors.Part] = {
{% for part in parts %}
    {{ part.period }}{{ "}" if loop.last else "," }}{{ ' "Sample period of each part";' if loop.last }}
{% endfor %}
{% if interface == "Triad" %}
  Modelica.Blocks.Interfaces.RealOutput y[3](each unit="{{ unit }}") "Output, body axes"
    annotation(Placement(transformation(extent={{ "{{100,-10},{120,10}}" }})));
{% endif %}
{% for line in connectors %}
  {{ line }}
{% endfor %}
{% for part in parts %}
  PyImu.Sensors.Parts.{{ part.name }}.{{ name }} {{ part.block }}(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.{{ part.name }};
{% endfor %}
equation
{% for part in parts %}
{% for input in ["rate", "specificForce", "temperature"] + part.extra %}
  connect({{ input }}, {{ part.block }}.{{ input }});
{% endfor %}
{% for output in outputs %}
  connect({{ part.block }}.{{ output }}, {{ output }});
{% endfor %}
{% endfor %}
  annotation(Documentation(info="<html>
<p>One of the built-in parts, chosen by <code>part</code>, with its own effects and no others. The
sample period is the part's own unless another is given.</p>
</html>"));
end {{ name }};
