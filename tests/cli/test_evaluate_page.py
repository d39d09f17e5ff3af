# SPDX-License-Identifier: Apache-2.0
"""`bounce evaluate` from end to end with stand-ins for the other engines: a killed run goes on, and its page works in a
real browser."""

import fcntl
import json
import os
import signal
import subprocess
import time

import pytest

import browser
from fake_engines import arguments_of, environment_of, jobs

CHROMIUM = browser.find()


def wait_until_unlocked(folder):
    """Until the programs that a killed run had started have ended as well: they keep its temporary files."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX)
    finally:
        os.close(handle)


def test_a_killed_run_goes_on_where_it_stopped(binary, bounce, scene, engines, tmp_path):
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    environment = {**environment_of(engines, tmp_path), "TMPDIR": str(temporary)}
    command = arguments_of(engines, scene, "report")
    (engines / "hang").write_text("16", encoding="utf-8")
    with subprocess.Popen([binary, *map(str, command)], cwd=tmp_path, env={**os.environ, **environment},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        # All points of Cycles are done, the first half of the reference is not.
        for line in process.stdout:
            if "frame 11, 4 spp" in line:
                break
        process.send_signal(signal.SIGKILL)
    assert not (tmp_path / "report/results.json").exists(), "half a report"
    points = list((tmp_path / "report/points").iterdir())
    assert len(points) == 1
    finished = (points[0] / "stats.json").stat().st_mtime_ns
    before = len(jobs(engines))
    (engines / "hang").unlink()
    left = list(temporary.iterdir())
    assert left, "a killed process cannot remove its folders"
    for folder in left:
        wait_until_unlocked(folder)

    done = bounce(*command, "--resume", environment=environment)
    assert done.returncode == 0, done.stderr
    assert not list(temporary.iterdir()), "the next run removes them"
    again = jobs(engines)[before:]
    assert [job["script"] for job in again] == ["cycles_render.py"], "Eevee and f3d were finished"
    asked = [(frame["frame"], item["spp"]) for frame in again[0]["frames"] for item in frame["renders"]]
    assert asked == [(10, 16), (10, 16), (11, 16), (11, 16)]
    assert (points[0] / "stats.json").stat().st_mtime_ns == finished, "Bounce's own run was finished too"
    results = json.loads((tmp_path / "report/results.json").read_text(encoding="utf-8"))
    assert {curve["name"] for curve in results["curves"]} == {"Cycles", "Eevee", "f3d", "Direct light only"}
    own = next(curve for curve in results["curves"] if curve["name"] == "Direct light only")
    assert own["points"][0]["rss_peak_bytes"] > 1 << 20
    assert own["points"][0]["gl_peak_bytes"] > 0
    assert [item["engine"] for item in results["startup"]] == ["Bounce", "Cycles", "Eevee", "f3d"]
    started = results["startup"][0]
    assert min(started[part] for part in ("start_seconds", "load_seconds", "first_render_seconds")) > 0
    # The stand-in's first render is what it tells; its start is timed by itself, where that is less than the whole.
    assert results["startup"][1]["first_render_seconds"] == 0.5
    for row in results["startup"][1:]:
        assert row["load_seconds"] > 0
        assert ("timed by itself" in row["note"]) == (row["start_seconds"] is not None), row
    assert results["passes"][0]["passes"]


def test_missing_engines_are_sentences(bounce, scene, engines, tmp_path):
    for name in ("f3d", "xvfb-run"):
        (engines / name).unlink()
    environment = environment_of(engines, tmp_path)
    environment["PATH"] = str(engines) + ":" + str(tmp_path / "nothing")
    # The stand-in for Blender is found by its path, and its interpreter by env.
    (engines / "python3").symlink_to("/usr/bin/python3")
    done = bounce(*arguments_of(engines, scene, "report"), environment=environment)
    assert done.returncode == 0, done.stderr
    assert "Debian's package xvfb" in done.stderr
    assert "Debian's package f3d" in done.stderr
    results = json.loads((tmp_path / "report/results.json").read_text(encoding="utf-8"))
    assert [bool(peer["left_out"]) for peer in results["peers"]] == [True, True]
    none = bounce(*arguments_of(engines, scene, "report"), "--peers", "none", environment=environment)
    assert none.returncode == 0 and "left out" not in none.stderr


@pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed here; Debian's package chromium")
def test_the_page_works_in_a_browser(bounce, scene, engines, tmp_path):
    done = bounce(*arguments_of(engines, scene, "report"), "--final-render", environment=environment_of(engines, tmp_path))
    assert done.returncode == 0, done.stderr
    page = tmp_path / "elsewhere.html"
    os.rename(tmp_path / "report/index.html", page)  # alone, without the folder beside it
    results = json.loads((tmp_path / "report/results.json").read_text(encoding="utf-8"))
    points = [point for curve in results["curves"] for point in curve["points"]]
    with browser.Browser(CHROMIUM, 1400, 900) as window:
        window.open(page)
        chart = "Chart.getChart('chart')"
        shown = window.evaluate(f"{chart}.data.datasets.flatMap(d => d.data.filter(i => i.point)).length")
        assert shown == sum(point["relmse"] > 0 for point in points) > 0
        logarithmic = window.evaluate(f"[{chart}.scales.x.type, {chart}.scales.y.type]")
        assert logarithmic == ["logarithmic", "logarithmic"]

        # Hover: the mouse over a point tells its figures.
        x, y = window.evaluate(f"(() => {{ const box = document.getElementById('chart').getBoundingClientRect();"
                               f"const c = {chart}; const at = c.data.datasets.findIndex(d => d.data[0].point);"
                               f"const p = c.getDatasetMeta(at).data[0]; return [box.x + p.x, box.y + p.y]; }})()")
        window.mouse("mouseMoved", x, y)
        window.wait(f"{chart}.tooltip.opacity > 0")
        told = " ".join(window.evaluate(f"{chart}.tooltip.body.flatMap(b => b.lines)"))
        assert "relMSE" in told and "a frame" in told

        # The wipe follows the mouse, and the picture is cut there.
        window.evaluate("document.getElementById('stage').scrollIntoView()")
        box = window.evaluate("(() => { const b = document.getElementById('stage').getBoundingClientRect();"
                              "return [b.x, b.y, b.width, b.height]; })()")
        cut = "document.getElementById('right-image').style.clipPath"
        before = window.evaluate(cut)
        assert "50%" in before
        middle = box[1] + box[3] / 3
        window.mouse("mousePressed", box[0] + box[2] / 2, middle, 1)
        window.mouse("mouseMoved", box[0] + box[2] / 4, middle, 1)
        window.mouse("mouseReleased", box[0] + box[2] / 4, middle)
        after = window.evaluate("Number(document.getElementById('wipe').value)")
        assert 230 < after < 270
        assert window.evaluate(cut) != before

        # Another picture, its maps, and the other frame.
        tag = "document.getElementById('left-tag').textContent"
        first = window.evaluate(tag)
        window.evaluate("(() => { const s = document.getElementById('left'); s.selectedIndex = 1;"
                        "s.dispatchEvent(new Event('change')); })()")
        second = window.evaluate(tag)
        assert second != first and second in window.evaluate("document.getElementById('flip-caption').textContent")
        for name in ("left-image", "right-image", "difference", "flip"):
            window.wait(f"document.getElementById('{name}').naturalWidth === 32")
        window.evaluate("document.querySelectorAll('#frame-tabs button')[1].click()")
        assert "Frame 11" in window.evaluate("document.querySelector('#frame-tabs [aria-pressed=true]').textContent")
        window.evaluate("document.querySelectorAll('#mode-tabs button')[1].click()")
        assert window.evaluate(cut) == "none"

        # Passes, the frame plan, start-up, the command.
        assert window.evaluate("Chart.getChart('passes').data.datasets.length") > 0
        assert window.evaluate("document.querySelectorAll('#plan-ran tr').length") > 0
        assert window.evaluate("document.querySelectorAll('#plan-left-out dd').length") > 0
        assert window.evaluate("document.querySelectorAll('#startup tbody tr').length") == 4
        shown = window.evaluate("[...document.querySelectorAll('#startup tbody tr:first-child td')].map(cell => cell.textContent)")
        assert [text == "–" for text in shown] == [False, True, True, False, False, False, False], shown
        bars = "Chart.getChart('passes').data.datasets.map(d => d.data[0])"
        assert sum(window.evaluate(bars)) == pytest.approx(
            1000 * sum(item["seconds"] for item in results["passes"][0]["passes"]), rel=1e-6)
        window.evaluate("document.querySelectorAll('#passes-tabs button')[1].click()")
        assert sum(window.evaluate(bars)) == pytest.approx(100, rel=1e-6)

        # Each frame of a chosen point, and what wins within a time.
        window.evaluate("(() => { const s = document.getElementById('frames-point'); s.selectedIndex = 1;"
                        "s.dispatchEvent(new Event('change')); })()")
        assert window.evaluate("Chart.getChart('frames-chart').data.datasets[0].data") == [
            frame["relmse"] for frame in points[1]["frames"]]
        assert window.evaluate("[...document.querySelectorAll('#frames-table tbody td:first-child')]"
                               ".map(cell => Number(cell.textContent))") == results["frames"]
        rows = window.evaluate("[...document.querySelectorAll('#budgets tbody tr')].map(row => row.textContent)")
        assert [("no point" in row) for row in rows] == ["options" not in item for item in results["budgets"]]
        assert "--technique direct" in rows[-1]
        assert "evaluate" in window.evaluate("document.getElementById('command').textContent")

        # From frame to frame: the reference and every point, sorted by a click on a heading, rising and falling.
        steps = [point["sequence"]["flip_step_mean"] for point in points]
        assert window.evaluate("document.querySelectorAll('#sequence tbody tr').length") == len(points) + 1
        column = "[...document.querySelectorAll('#sequence tbody tr:not(.reference) td:nth-child(3)')].map(c => Number(c.textContent))"
        for wanted in (sorted(steps), sorted(steps, reverse=True)):
            window.evaluate("document.querySelector('#sequence th:nth-child(3) button').click()")
            assert window.evaluate(column) == pytest.approx(wanted, rel=0.01)
        # The final render: every point below the matched reference, and among the pictures.
        assert window.evaluate("document.querySelectorAll('#final tbody tr').length") == len(points) + 1
        assert "Matched reference" in window.evaluate("document.querySelector('#final tbody tr').textContent")
        window.evaluate("(() => { const s = document.getElementById('right'); s.value = 'Final render';"
                        "s.dispatchEvent(new Event('change')); })()")
        window.wait("document.getElementById('right-image').naturalWidth === 32")
        assert "own light paths" in window.evaluate("document.getElementById('right-caption').textContent")
        assert not window.evaluate("document.getElementById('maps').hidden"), "of the picture to the left"
        assert window.evaluate("document.querySelectorAll('#sequence-meanings dt').length") == 3, "no flicker of two frames"
        assert "HDR" in window.evaluate("document.getElementById('points').textContent")

        # Dark where the system is, and no wider than the window at any size.
        light = window.evaluate("getComputedStyle(document.body).backgroundColor")
        window.scheme("dark")
        window.wait(f"getComputedStyle(document.body).backgroundColor !== '{light}'")
        for width in (1400, 800, 420):
            window.resize(width, 900)
            window.wait(f"document.documentElement.scrollWidth <= {width}")
        time.sleep(0.2)
        assert window.errors == []
        others = [url for url in window.requests if not url.startswith(("data:", "file:///", "about:"))]
        assert others == []
        assert [url for url in window.requests if url.startswith("file:")] == [f"file://{page}"]
