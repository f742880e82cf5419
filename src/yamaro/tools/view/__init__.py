"""The robot in the browser while it is written: `yamaro view`."""
