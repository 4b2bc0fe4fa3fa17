{% from "function.mo" import function %}
within {{ within }};
{% filter outdented %}
{{ function(f, documentation) -}}
{% endfilter %}
