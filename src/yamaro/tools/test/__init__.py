"""`yamaro test`: what robots are expected to be, in files beside them."""
