"""What the words over a table mean: a vocabulary, the grammar of a column's name, and what comments say."""
