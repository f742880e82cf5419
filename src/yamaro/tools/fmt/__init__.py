"""One style for YAML files: `yamaro fmt`."""
