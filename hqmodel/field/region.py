"""Where the body is: the box that holds it, found by exact bounds alone."""
