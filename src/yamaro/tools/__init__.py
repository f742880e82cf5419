"""What stands on top of the compiler: a module each."""
