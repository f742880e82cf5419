"""`yamaro sweep plot`: a picture of what a sweep has found."""
