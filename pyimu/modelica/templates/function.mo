{% macro function(f, documentation="") %}
  function {{ f.name }} "{{ f.description | text }}"
    extends Modelica.Icons.Function;
{% for line in f.inputs %}
    {{ line }}
{% endfor %}
    output {{ f.result_declaration }};
{% if f.variables %}
  protected
{% for line in f.variables %}
    {{ line }}
{% endfor %}
{% endif %}
  algorithm
{% for line in f.lines %}
    {{ line }}
{% endfor %}
{% if documentation %}
    annotation(Documentation(info="<html>
{{ documentation | page }}
</html>"));
{% endif %}
  end {{ f.name }};
{% endmacro %}
