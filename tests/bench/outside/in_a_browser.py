#!/usr/bin/env python3
"""A method of task ik whose work a browser does: a page reads the problem and answers with its start pose."""
import html
import json
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "examples/outside-methods"))
from etude_method import NoAnswer, run  # noqa: E402

PAGE = """<script type="application/json" id="problem">{problem}</script><pre id="answer"></pre><script>
const problem = JSON.parse(document.getElementById("problem").textContent);
const answer = {{angles_deg: problem.start_angles_deg, iterations: 0}};
document.getElementById("answer").textContent = JSON.stringify(answer);
</script>"""


def answer(kept, problem, files):
    with tempfile.TemporaryDirectory() as scratch:
        page = pathlib.Path(scratch) / "page.html"
        page.write_text(PAGE.format(problem=json.dumps(problem)))
        # The fence is the sandbox: it lets no program make another one.
        shown = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                                f"--user-data-dir={scratch}/profile", "--dump-dom", page.as_uri()],
                               capture_output=True, text=True)
    found = re.search(r'<pre id="answer">(.*?)</pre>', shown.stdout, re.DOTALL)
    if not found:
        raise NoAnswer(f"no page (exit code {shown.returncode}): {shown.stderr[-300:]}")
    return json.loads(html.unescape(found[1]))


run("in-a-browser", "1.0", lambda setting, options, files: None, answer)
