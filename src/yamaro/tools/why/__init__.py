"""Where values of the output come from: `yamaro why`."""
