"""The hands: what can be taken hold of in the viewport, and what a drag of it makes of the scene."""
