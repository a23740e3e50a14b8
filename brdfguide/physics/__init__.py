"""What light does: no fitted parameters, no data."""
