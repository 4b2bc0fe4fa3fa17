"""Which effects to add: candidates, screening, forward selection, what is left over."""
