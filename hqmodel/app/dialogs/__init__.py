"""How each dialog is drawn; what it asks and what follows from the answer is elsewhere."""
