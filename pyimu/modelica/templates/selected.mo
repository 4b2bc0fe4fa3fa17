within PyImu.Sensors;
block {{ name }} "{{ description | text }}"
  extends PyImu.Interfaces.{{ interface }};
  parameter PyImu.Sensors.Part part = PyImu.Sensors.Part.{{ default }} "Which part"
    annotation(Evaluate=true);
{% if interface == "Triad" %}
  Modelica.Blocks.Interfaces.RealOutput y[3](each unit="{{ unit }}") "Output, body axes"
    annotation(Placement(transformation(extent={{ "{{100,-10},{120,10}}" }})));
{% endif %}
{% for part in parts %}
  PyImu.Sensors.Parts.{{ part.name }}.{{ name }} {{ part.block }}(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.{{ part.name }};
{% endfor %}
equation
{% for part in parts %}
{% for input in ["rate", "specificForce", "temperature"] %}
  connect({{ input }}, {{ part.block }}.{{ input }});
{% endfor %}
{% for output in outputs %}
  connect({{ part.block }}.{{ output }}, {{ output }});
{% endfor %}
{% endfor %}
  annotation(Documentation(info="<html>
<p>One of the built-in parts, chosen by <code>part</code>, with its own effects and no others. The
sample period is not the part's own: give it, as the part's data sheet has it or as the model needs
it.</p>
</html>"));
end {{ name }};
