"""Counts the tokens of `yamaro guide` by tokenizers that PyPI has without a download of their own.

pip install tokenizers tiktoken mistral-common 'anthropic==0.34.2' --no-deps
python bench/guide_tokens.py

`anthropic` up to 0.38 has the vocabulary of Claude 2 in it, of 65,000 tokens, and `mistral-common`
that of Tekken, of 131,000. Vocabularies of 2024 and later need fewer tokens than the former.
"""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

MOST = 6000


def main() -> int:
    """Print the counts; return 1 if one is too large or none could be made."""
    text = subprocess.run(
        [sys.executable, "-m", "yamaro", "guide"], check=True, capture_output=True, text=True
    ).stdout
    counts = {}
    spec = find_spec("anthropic")
    if spec is not None and spec.origin is not None and find_spec("tokenizers"):
        from tokenizers import Tokenizer

        vocabulary = Path(spec.origin).parent / "tokenizer.json"
        if vocabulary.is_file():
            counts["Claude 2"] = len(Tokenizer.from_file(str(vocabulary)).encode(text).ids)
    if find_spec("mistral_common"):
        from mistral_common.tokens.tokenizers.mistral import MistralTokenizer

        tekken = MistralTokenizer.v3(is_tekken=True).instruct_tokenizer.tokenizer
        counts["Tekken"] = len(tekken.encode(text, bos=False, eos=False))
    for name, count in counts.items():
        print(f"{name:10} {count:6,} tokens of {len(text):,} characters")
    return 0 if counts and max(counts.values()) < MOST else 1


if __name__ == "__main__":
    sys.exit(main())
