within PyImu.Interfaces;
partial block {{ name }} "{{ description | text }}"
{% for line in connectors %}
  {{ line }}
{% endfor %}
  annotation(Documentation(info="<html>
<p>{{ documentation | page }}</p>
</html>"));
end {{ name }};
