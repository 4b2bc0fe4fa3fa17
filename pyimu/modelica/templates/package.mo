within {{ within }};
package {{ name }} "{{ description | text }}"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
{{ ("<p>" ~ documentation ~ "</p>") | page }}
</html>"));
end {{ name }};
