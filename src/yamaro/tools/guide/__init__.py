"""`yamaro guide`: the language on one page, for programs that write robots."""
