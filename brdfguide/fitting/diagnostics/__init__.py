"""What a fitted number is worth: standard errors, intervals, bounds."""
