within {{ within }};
model {{ name }} "{{ description | text }}"
  extends Modelica.Icons.Example;
{% for line in declarations %}
  {{ line }}
{% endfor %}
equation
{% for line in connections %}
  {{ line }}
{% endfor %}
  annotation(
    experiment(StopTime={{ stop }}, Interval={{ period }}),
    Documentation(info="<html>
{{ ("<p>" ~ documentation ~ "</p>") | page }}
</html>"));
end {{ name }};
