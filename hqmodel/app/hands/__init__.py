"""The hand in the window: what the mouse and the keys do in the viewport, and what is drawn over the picture for it."""
