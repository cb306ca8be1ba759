"""The window's panels: each takes the session and returns what the user wants done."""
