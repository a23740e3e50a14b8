"""The public face: what `import brdfguide` gives, which the command line calls too."""
