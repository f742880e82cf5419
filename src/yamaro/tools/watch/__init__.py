"""A build at each save: `yamaro watch`."""
