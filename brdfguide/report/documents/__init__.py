"""Results as dictionaries for JSON: the only source of text and page."""
