"""Run every ``sh`` block of a Markdown file, in order, in the folder of the file.

A block that is expected to end with another exit code than 0 says so in a comment, ``# exit 1``.
"""

import re
import subprocess
import sys
import time
from pathlib import Path


def main(path: Path) -> int:
    """Exit code 0 if every block ended as it should."""
    blocks = re.findall(r"^```sh\n(.*?)^```", path.read_text(encoding="utf-8"), re.M | re.S)
    for block in blocks:
        expected = int(found.group(1)) if (found := re.search(r"# exit (\d+)", block)) else 0
        print(f"\n$ {block.strip()}", flush=True)
        began = time.perf_counter()
        code = subprocess.run(["bash", "-euo", "pipefail", "-c", block], cwd=path.parent).returncode
        print(f"[exit {code}, {time.perf_counter() - began:.0f} s]", flush=True)
        if code != expected:
            print(f"expected exit {expected}", file=sys.stderr)
            return 1
    print(f"\n{len(blocks)} blocks ran")
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
