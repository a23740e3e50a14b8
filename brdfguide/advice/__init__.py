"""From what a person sees or measured to a model, with reasons."""
