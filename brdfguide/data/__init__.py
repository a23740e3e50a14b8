"""What an instrument reported; knows no model."""
