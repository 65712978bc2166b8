"""Look at HTML pages in a headless Chromium: python .ci/chromium.py PAGE... [--to DIR]

On a desktop, on a phone of 400 pixels and on a phone in the dark: no error on the console, nothing
asked of the network, every figure drawn, no page wider than the screen, no text cut, text light on
dark. With --to a PNG of each view is written there. The browser is spoken to over two pipes in its
own protocol (https://chromedevtools.github.io/devtools-protocol/), so that Python alone will do.
"""

import argparse
import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
FLAGS = (
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
    "--disable-background-networking", "--disable-extensions", "--remote-debugging-pipe",
)  # fmt: skip
VIEWS = {"desktop": (1280, 900, "light"), "phone": (400, 800, "light"), "dark": (400, 800, "dark")}
PATIENCE = 60.0  # seconds for an answer

# The number of pictures, and what a reader would complain of on a screen of some width. A phone
# widens its window to hold a page that is too wide, so that the window is no measure.
COMPLAINTS = r"""(width => {
  document.querySelectorAll('details').forEach(e => e.open = true);
  const found = [], dark = matchMedia('(prefers-color-scheme: dark)').matches;
  const name = e => `<${e.tagName.toLowerCase()}> ${e.textContent.slice(0, 60)}`;
  const page = document.documentElement;
  if (document.scripts.length) found.push('the page has a script');
  if (Math.max(page.scrollWidth, innerWidth, document.body.scrollWidth) > width)
    found.push(`the page is ${page.scrollWidth} wide on a screen of ${width}`);
  const ids = [...document.querySelectorAll('[id]')].map(e => e.id);
  for (const id of new Set(ids.filter((x, i) => ids.indexOf(x) < i))) found.push('twice: id ' + id);
  const scrolls = e => ['auto', 'scroll'].includes(getComputedStyle(e).overflowX);
  const inScroll = e => e && e !== document.body && (scrolls(e) || inScroll(e.parentElement));
  for (const e of document.querySelectorAll('body *')) {
    if (e.closest('svg') || !e.getClientRects().length) continue;
    const box = e.getBoundingClientRect();
    if (!inScroll(e) && (box.right > width + 1 || box.left < -1))
      found.push(`beyond the edge: ${name(e)}`);
    const hides = ['hidden', 'clip'].includes(getComputedStyle(e).overflowX);
    if (hides && e.scrollWidth > e.clientWidth + 1)
      found.push(`cut: ${name(e)}`);
  }
  const light = c => { const v = c.match(/[\d.]+/g).slice(0, 3).map(Number);
    return (0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]) / 255; };
  const ground = light(getComputedStyle(document.body).backgroundColor);
  if (dark ? ground > 0.2 : ground < 0.8) found.push('the ground is ' + ground);
  for (const e of document.querySelectorAll('p, h1, h2, li, td, dd')) {
    const ink = light(getComputedStyle(e).color);
    if (dark ? ink < 0.5 : ink > 0.5) found.push(`ink ${ink}: ${name(e)}`);
  }
  for (const figure of document.querySelectorAll('figure'))
    if (!figure.querySelector('svg')) found.push('no picture in ' + name(figure));
  for (const svg of document.querySelectorAll('svg')) {
    const frame = svg.getBoundingClientRect(), drawn = svg.getBBox();
    const label = svg.querySelector('title');
    if (!(frame.width > 50 && frame.height > 50 && drawn.width > 0 && drawn.height > 0))
      found.push(`not drawn: ${label && label.textContent}`);
    if (!label || !svg.querySelector('desc')?.textContent) found.push('a picture without words');
    const texts = [...svg.querySelectorAll('[id*="text_"]')];
    if (!texts.length) found.push(`no text in ${label && label.textContent}`);
    for (const text of texts) {
      const box = text.getBoundingClientRect();
      if (!box.width) continue;
      if (box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 ||
          box.bottom > frame.bottom + 1) found.push(`text cut: ${text.id} of ${label.textContent}`);
      const glyph = text.querySelector('use');
      const ink = light(getComputedStyle(glyph).fill);
      if (dark ? ink < 0.5 : ink > 0.5)
        found.push(`ink ${ink}: ${text.id} of ${label.textContent}`);
    }
  }
  return [document.querySelectorAll('svg').length, found];
})"""


@dataclass
class Browser:
    """A running Chromium; ``events`` are those not yet looked at."""

    process: subprocess.Popen[bytes]
    orders: int
    answers: int
    sent: int = 0
    unread: bytes = b""
    events: list[dict[str, Any]] = field(default_factory=list)

    def close(self) -> None:
        """End the process and close the pipes."""
        self.process.kill()
        self.process.wait()
        os.close(self.orders)
        os.close(self.answers)


def executable() -> str:
    """The browser: $CHROMIUM, one on the path, or one that playwright has installed."""
    asked = os.environ.get("CHROMIUM")
    found = [asked] if asked else [p for n in NAMES if (p := shutil.which(n))]
    cache = Path(os.environ.get("PLAYWRIGHT_BROWSERS_PATH", Path.home() / ".cache/ms-playwright"))
    found += [] if found else sorted(map(str, cache.glob("chromium-*/chrome-*/chrome")))
    if not found:
        sys.exit("a Chromium is needed (Debian: apt-get install chromium): got none")
    return found[0]


def start(folder: str) -> Browser:
    """A browser with a fresh profile in the folder."""
    read_orders, orders = os.pipe()
    answers, write_answers = os.pipe()

    def wire() -> None:  # the browser reads file 3 and writes file 4
        kept = os.dup(write_answers)
        os.dup2(read_orders, 3)
        os.dup2(kept, 4)

    command = [executable(), *FLAGS, f"--user-data-dir={folder}", "about:blank"]
    process = subprocess.Popen(
        command, preexec_fn=wire, pass_fds=(3, 4), stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )  # fmt: skip
    os.close(read_orders)
    os.close(write_answers)
    os.set_blocking(answers, False)
    return Browser(process, orders, answers)


def read(browser: Browser) -> dict[str, Any]:
    """The next message."""
    late = time.monotonic() + PATIENCE
    while b"\0" not in browser.unread:
        if browser.process.poll() is not None or time.monotonic() > late:
            sys.exit(f"the browser must answer: got exit code {browser.process.poll()}")
        try:
            browser.unread += os.read(browser.answers, 1 << 20)
        except BlockingIOError:
            time.sleep(0.01)
    message, browser.unread = browser.unread.split(b"\0", 1)
    return json.loads(message)


def call(browser: Browser, method: str, session: str = "", **parameters: Any) -> dict[str, Any]:
    """The result of a command."""
    browser.sent += 1
    order: dict[str, Any] = {"id": browser.sent, "method": method, "params": parameters}
    if session:
        order["sessionId"] = session
    os.write(browser.orders, json.dumps(order).encode() + b"\0")
    while True:
        message = read(browser)
        if message.get("id") == browser.sent:
            if "error" in message:
                sys.exit(f"{method} must succeed: got {message['error']}")
            return message["result"]
        browser.events.append(message)


def wait(browser: Browser, event: str) -> None:
    """Until an event has come."""
    while not any(e.get("method") == event for e in browser.events):
        browser.events.append(read(browser))


def look(browser: Browser, page: Path, view: str, to: Path | None) -> tuple[int, list[str]]:
    """The number of pictures, and the complaints on one view of a page."""
    width, height, scheme = VIEWS[view]
    browser.events.clear()
    target = call(browser, "Target.createTarget", url="about:blank")["targetId"]
    session = call(browser, "Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
    for domain in ("Page", "Runtime", "Log", "Network"):
        call(browser, f"{domain}.enable", session)
    call(
        browser, "Emulation.setDeviceMetricsOverride", session, width=width, height=height,
        deviceScaleFactor=1, mobile=view != "desktop",
    )  # fmt: skip
    feature = {"name": "prefers-color-scheme", "value": scheme}
    call(browser, "Emulation.setEmulatedMedia", session, features=[feature])
    call(browser, "Page.navigate", session, url=page.resolve().as_uri())
    wait(browser, "Page.loadEventFired")
    if to is not None:
        shot = call(
            browser, "Page.captureScreenshot", session, format="png", captureBeyondViewport=True
        )
        name = f"{page.resolve().parent.name}-{view}.png"
        (to / name).write_bytes(base64.b64decode(shot["data"]))
    answer = call(
        browser,
        "Runtime.evaluate",
        session,
        expression=f"{COMPLAINTS}({width})",
        returnByValue=True,
    )
    if "value" not in answer["result"]:
        sys.exit(f"the page must be looked at: got {json.dumps(answer)[:500]}")
    count, found = answer["result"]["value"]
    found += [c for e in browser.events if (c := complaint(e, page))]
    call(browser, "Target.closeTarget", targetId=target)
    return count, found


def complaint(event: dict[str, Any], page: Path) -> str | None:
    """What an event says against a page: an error, or a request of anything but itself."""
    method, told = event.get("method"), event.get("params", {})
    if method == "Runtime.exceptionThrown":
        return f"exception: {told['exceptionDetails'].get('text')}"
    if method == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
        return f"console: {told['args']}"
    if method == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
        return f"log: {told['entry']['text']}"
    if method == "Network.requestWillBeSent":
        url = told["request"]["url"]
        if url != page.resolve().as_uri() and not url.startswith(("data:", "about:")):
            return f"asked of the network: {url}"
    return None


def main() -> int:
    """Exit code 0 if there is nothing to complain of."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("pages", nargs="+", type=Path, metavar="PAGE")
    parser.add_argument("--to", type=Path, metavar="DIR", help="write a PNG of each view there")
    parsed = parser.parse_args()
    if parsed.to is not None:
        parsed.to.mkdir(parents=True, exist_ok=True)
    bad = 0
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        browser = start(folder)
        try:
            for page in parsed.pages:
                for view in VIEWS:
                    count, found = look(browser, page, view, parsed.to)
                    print(f"{page}, {view}: {count} pictures, {len(found)} complaints")
                    print("".join(f"  {line}\n" for line in found[:20]), end="")
                    bad += len(found)
            call(browser, "Browser.close")
        finally:
            browser.close()
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
