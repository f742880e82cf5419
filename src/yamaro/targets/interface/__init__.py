"""The interface of a robot: what each program calls its joints, and in which order it has them."""
