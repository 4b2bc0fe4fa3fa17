"""What would explain a finding as well: noise, rounding, a reference's clock or its scale."""
