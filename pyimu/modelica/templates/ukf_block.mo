block {{ name }} "{{ description | text }}"
  extends PyImu.Interfaces.Sampled(samplePeriod={{ period }});
{% for line in declarations %}
  {{ line }}
{% endfor %}
protected
{% for line in hidden %}
  {{ line }}
{% endfor %}
initial equation
  {{ start }}
equation
{% for line in equations %}
  {{ line }}
{% endfor %}
  annotation(Icon(graphics={
      Rectangle(extent={{ "{{-94,94},{94,-94}}" }}, lineColor={255,255,255}, fillColor={255,255,255},
        fillPattern=FillPattern.Solid),
      Text(extent={{ "{{-90,50},{90,-10}}" }}, textString="UKF", textColor={0,0,127}),
      Text(extent={{ "{{-90,-20},{90,-70}}" }}, textString="attitude", textColor={128,128,128})}),
    Documentation(info="<html>
{{ documentation | page }}
</html>"));
end {{ name }};
