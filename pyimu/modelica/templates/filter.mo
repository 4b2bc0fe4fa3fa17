within PyImu.ShapingFilters;
block {{ name }} "{{ effect.term | capital | text }}, of one axis, as a filter on white noise"
  extends PyImu.Icons.Effect;
{% for line in parameters %}
  {{ line }}
{% endfor %}
  Modelica.Blocks.Interfaces.RealInput u{{ size }} "White noise of two-sided density 1"
    annotation(Placement(transformation(extent={{ "{{-140,-20},{-100,20}}" }})));
  Modelica.Blocks.Interfaces.RealOutput y "Noise"
    annotation(Placement(transformation(extent={{ "{{100,-10},{120,10}}" }})));
{% if hidden %}
protected
{% for line in hidden %}
  {{ line }}
{% endfor %}
{% endif %}
equation
{% for line in equations %}
  {{ line }}
{% endfor %}
  annotation(Documentation(info="<html>
{{ documentation | page }}
</html>"));
end {{ name }};
