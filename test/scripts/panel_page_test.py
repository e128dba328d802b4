#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The page of the panel in a headless Chromium, without ROS; skipped where there is none."""
import http.server
import math
import os
import sys
import threading
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import browser  # noqa: E402
from panel_fixture import LONG_NAME, PanelTestCase  # noqa: E402

NO_BROWSER = "no chromium on this machine: the page is not tested in a browser; Debian's package chromium has one"

# Texts whose contrast with what is behind them is below that of WCAG 2.1, level AA.
CONTRASTS = """(() => {
  const parse = text => { const [r, g, b, a = 1] = text.match(/[\\d.]+/g).map(Number); return {rgb: [r, g, b], a}; };
  const light = ({rgb}) => { const [r, g, b] = rgb.map(c => (c /= 255) <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const behind = e => { for (; e; e = e.parentElement) { const c = parse(getComputedStyle(e).backgroundColor); if (c.a > 0) return c; } return {rgb: [255, 255, 255]}; };
  return [...document.querySelectorAll('h1, h2, p, label, button:enabled, input:enabled, select, legend, td, th, caption, a, summary, span, strong, footer')]
    .filter(e => e.offsetParent && e.textContent.trim()).map(e => {
      const a = light(parse(getComputedStyle(e).color)), b = light(behind(e)), ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
      return [e.tagName, e.textContent.slice(0, 20), ratio];
    }).filter(([, , ratio]) => ratio < 4.5);
})()"""

# Numbers and headings of the result that take more than one line.
BROKEN = """[...document.querySelectorAll('td, th[scope=col]')].filter(e => {
  const range = document.createRange(); range.selectNodeContents(e); return new Set([...range.getClientRects()].map(r => r.top)).size > 1;
}).map(e => e.textContent)"""


@unittest.skipUnless(browser.PATH, NO_BROWSER)
class PageTest(PanelTestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = browser.Browser()
        cls.addClassCleanup(cls.page.close)

    def setUp(self):
        super().setUp()
        for k in range(40):
            self.frame(k)
        self.page.errors.clear()
        self.page.resize(1280)
        self.page.open(f"http://localhost:{self.port}/")
        self.page.wait("document.querySelectorAll('svg').length === 3")

    def text(self, name):
        return self.page.run(f"document.getElementById('{name}').textContent")

    def wait_for_asked(self, *expected):
        self.page.wait_for(lambda: all(each in self.nodes.asked for each in expected), f"never asked: {expected}")

    def finish_job(self):
        self.board.tell("job", kind="optimization", result={
            "job": "arm_1", "success": True, "message": "success", "summary": "objective 2 to 1", "columns": ["parameter", "initial", "tuned"],
            "rows": [["length", 0.5, 0.1 + 0.2], [LONG_NAME, 1.0, None]], "values": {"length": 0.1 + 0.2}, "warnings": ["parameter_on_bound: <b>wide</b>"], "bag": "/a/b.bag"})
        self.page.wait("!document.getElementById('result').hidden")

    def test_it_fits_wide_and_narrow_windows_in_light_and_dark(self):
        self.finish_job()
        for width in (1280, 400, 320):
            for scheme in ("light", "dark"):
                self.page.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
                self.page.resize(width)
                self.assertEqual(self.page.run("document.documentElement.scrollWidth"), width)
                outside = self.page.run("[...document.querySelectorAll('body *')].filter(e => e.getBoundingClientRect().right > innerWidth + 0.5).map(e => e.tagName)")
                self.assertEqual(outside, [])
                self.assertEqual(self.page.run(BROKEN), [], width)
                self.assertEqual(self.page.run(CONTRASTS), [], scheme)

    def test_everything_one_can_operate_has_a_name_and_a_place_in_the_order_of_tab(self):
        self.finish_job()
        controls = self.page.controls()
        self.assertEqual([each for each in controls if not each[1].strip()], [])
        for control in (("slider", "length [m]"), ("spinbutton", "length [m]"), ("spinbutton", "servo"), ("button", "Set the effort of elbow"), ("button", "Pause"),
                        ("button", "Remove the curve of elbow/friction"), ("link", "Report of this job (new tab)"), ("combobox", "Signal")):
            self.assertIn(control, controls)
        self.assertEqual(self.page.run("[...document.querySelectorAll('[role=status]')].map(e => e.id)"), ["state", "job-state", "said"])
        label = self.page.run("document.querySelector('svg').getAttribute('aria-label')")
        self.assertRegex(label, "elbow/friction over 10 s: now 0.7259, from -1 to 0.9991")
        # Every control that is not disabled gets the focus by the key Tab, in the order of the page, and shows it.
        wanted = self.page.run("[...document.querySelectorAll('button, input, select, a, summary')].filter(e => !e.disabled && e.offsetParent).length")
        self.page.run("document.body.focus(); window.seen = []; document.addEventListener('focusin', e => seen.push(e.target))")
        for _ in range(wanted):
            self.page.press("Tab")
        self.assertEqual(self.page.run("new Set(seen).size"), wanted)
        self.assertTrue(self.page.run("seen.every((e, k) => k === 0 || seen[k - 1].compareDocumentPosition(e) & Node.DOCUMENT_POSITION_FOLLOWING)"))
        self.assertEqual(self.page.run("getComputedStyle(document.activeElement).outlineStyle"), "solid")

    def test_the_keyboard_drives_the_nodes(self):
        self.page.run("document.getElementById('pause').focus()")
        self.page.press("Enter")
        self.page.wait("document.getElementById('said').textContent === 'pause is done'")
        self.board.tell("simulation", values={"robot": "arm", "waits for": "~step or ~resume"})
        self.page.wait("document.getElementById('state').textContent === 'paused simulation'")
        self.page.press(" ")
        self.wait_for_asked(("pause", {}), ("resume", {}))
        self.page.run("document.querySelector('input[type=range]').focus()")
        self.page.press("ArrowRight")
        self.wait_for_asked(("parameters", {"values": {"length": 0.505}}))
        self.page.run("document.getElementById('effort-0').focus()")
        self.page.type("-1.5")
        self.page.press("Enter")
        self.page.run("document.getElementById('setpoint-1').focus()")
        self.page.type("3")
        self.page.press("Enter")
        self.wait_for_asked(("effort", {"name": "elbow", "value": -1.5}), ("setpoint", {"name": LONG_NAME, "value": 3}))
        self.page.run("document.getElementById('optimize').click()")
        self.wait_for_asked(("optimize", {}))
        self.assertEqual(self.page.errors, [])

    def test_what_is_refused_is_said(self):
        self.board.tell("commands", efforts={"refused": 0.0})
        self.page.wait("document.querySelector('#efforts label').textContent === 'refused'")
        self.page.run("document.getElementById('effort-0').focus()")
        self.page.type("1")
        self.page.press("Enter")
        self.page.wait("document.getElementById('said').textContent === 'Refused: refused: no such joint'")

    def test_a_job_its_progress_and_its_result(self):
        told = {"job": "arm_1", "stage": "searching", "done": 3, "of": 12, "evaluation": 3, "best": 0.25, "at_most": True, "left": 9.0, "values": {"length": 0.45}}
        self.board.tell("job", kind="optimization", running=True, told=told)
        self.page.wait("!document.getElementById('progress').hidden")
        self.assertEqual(self.text("job-state"), "optimization arm_1: searching")
        self.assertEqual(self.text("job-told"), "3 of at most 12, evaluation 3, best objective 0.25, at most 9 s left; length 0.45")
        self.assertEqual(self.page.run("document.getElementById('progress').position"), 0.25)
        self.page.run("document.getElementById('cancel').click()")
        self.wait_for_asked(("cancel", {}))
        self.board.tell("job", running=False)
        self.finish_job()
        self.assertIn("<b>wide</b>", self.text("result"), "text of a model is no HTML")
        self.page.run("document.querySelector('#result button').click()")
        self.wait_for_asked(("parameters", {"values": {"length": 0.1 + 0.2}}))
        self.assertEqual(self.page.errors, [])

    def test_curves_are_added_removed_and_kept_over_a_reload(self):
        self.page.run("document.getElementById('signal').value = 'elbow/position'")
        names = "[...document.querySelectorAll('figure')].map(e => e.dataset.name)"
        self.assertEqual(self.page.run(names), ["elbow/friction", "elbow/position", f"{LONG_NAME}/position"])
        self.page.run("document.querySelector('figure button').click()")
        self.page.open(f"http://localhost:{self.port}/" + self.page.run("location.hash"))
        self.page.reload()
        self.page.wait("document.querySelectorAll('svg').length === 2")
        self.assertEqual(self.page.run(names), ["elbow/position", f"{LONG_NAME}/position"])
        self.page.run("document.getElementById('signal').value = 'elbow/friction'; document.getElementById('add').click()")
        self.page.wait("document.querySelectorAll('svg').length === 3")

    def test_a_peak_of_one_frame_among_thousands_stays_in_the_picture(self):
        for k in range(40, 3000):
            self.board.curves.add("joint_friction", 4.0 + 0.002 * k, ["elbow"], ("friction",), [[50.0 if k == 1234 else 1.0]])
        self.page.wait("document.querySelector('figure .values').textContent === 'now 1, from -1 to 50'")
        points = self.page.run("document.querySelector('polyline').getAttribute('points')").split()
        self.assertLess(len(points), 1500)
        heights = sorted(float(point.partition(",")[2]) for point in points)
        self.assertLess(heights[0], heights[1] - 50.0, "one point stands far above the others")

    def test_an_arrow_key_in_a_number_is_one_step_of_its_slider(self):
        self.page.run("document.getElementById('parameter-0').focus()")
        self.page.press("ArrowUp")
        self.page.press("Enter")
        self.wait_for_asked(("parameters", {"values": {"length": 0.505}}))

    def test_a_node_that_ends_is_said(self):
        self.board.tell("simulation", seen=-math.inf)
        self.page.wait("document.getElementById('state').textContent === 'The node /simulation does not answer.'")

    def test_curves_of_a_robot_that_is_gone_are_its_last_ones(self):
        values = "[...document.querySelectorAll('figure .values')].map(e => e.textContent.slice(0, 4))"
        self.assertEqual(self.page.run(values), ["now "] * 3)
        self.board.tell("simulation", seen=-math.inf)
        for track in self.board.curves._tracks.values():
            track["seen"] = -math.inf
        self.page.wait("document.querySelectorAll('figure.gone').length === 3")
        self.assertEqual(self.page.run(values), ["last"] * 3)
        self.assertIn("The node /simulation does not answer: these are its last curves.", self.text("no-curves"))
        self.assertEqual(self.page.run("[...document.querySelectorAll('#pause, #step, #restart, #parameters input, #defaults, #efforts button')].filter(e => !e.matches(':disabled')).length"), 0)
        for _ in range(2):
            self.board.tell("simulation", seen=time.monotonic() + 1e6)
            self.frame(41)
        self.page.wait("document.querySelectorAll('figure.gone').length === 0")
        self.assertEqual(self.page.run("document.getElementById('pause').disabled"), False)

    def test_an_answer_stands_at_its_control(self):
        for width in (1280, 400):
            self.page.resize(width, 600)
            for control, act, text in (("pause", "document.getElementById('pause').click()", "pause is done"),
                                       ("parameter-1", "{const f = document.getElementById('parameter-1'); f.value = 3; f.dispatchEvent(new Event('change'))}", "parameters is done"),
                                       ("effort-0", "{const f = document.getElementById('effort-0'); f.value = 1; f.form.requestSubmit()}", "effort is done"),
                                       ("optimize", "document.getElementById('optimize').click()", "optimize is done")):
                self.page.run(f"document.getElementById('{control}').scrollIntoView({{block: 'center'}}); {act}")
                self.page.wait(f"document.querySelector('.answer')?.textContent === '{text}'")
                distance = self.page.run(f"document.querySelector('.answer').getBoundingClientRect().top - document.getElementById('{control}').getBoundingClientRect().bottom")
                self.assertTrue(-1.0 <= distance < 90.0, f"{control}, {width}: {distance}")
                self.assertEqual(self.page.run("document.querySelectorAll('.answer').length"), 1)
                self.assertEqual(self.text("said"), text, "for a screen reader")

    def test_a_page_of_another_site_can_neither_read_nor_command(self):
        class Foreign(http.server.BaseHTTPRequestHandler):
            def do_GET(self):  # noqa: N802
                self.send_response(200)
                self.send_header("Content-Type", "text/html")
                self.end_headers()

            def log_message(self, *_):
                pass

        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Foreign) as foreign:
            threading.Thread(target=foreign.serve_forever, daemon=True).start()
            self.addCleanup(foreign.shutdown)
            self.page.open(f"http://127.0.0.1:{foreign.server_address[1]}/")
            for options in ("{method: 'POST', mode: 'no-cors', body: '{\"do\": \"pause\"}'}",
                            "{method: 'POST', headers: {'Content-Type': 'application/json'}, body: '{\"do\": \"pause\"}'}", "{}"):
                for host in ("localhost", "127.0.0.1"):
                    path = "events" if options == "{}" else "do"
                    seen = self.page.run(f"fetch('http://{host}:{self.port}/{path}', {options}).then(r => r.type === 'opaque' ? 'opaque' : r.status, () => 'blocked')")
                    self.assertIn(seen, ("opaque", "blocked"))
            foreign.shutdown()
        self.assertEqual(self.nodes.asked, [])


if __name__ == "__main__":
    if not browser.PATH:
        print(NO_BROWSER)
    unittest.main()
