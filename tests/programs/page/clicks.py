#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Uses the monitor's page as a user does, in a headless Chromium, and asks the program after each click what it did.
Prints a line for each check."""

import json
import os
import sys

from browser import Failure, Page, until
from monitored import Program

HERE = os.path.dirname(os.path.abspath(__file__))
SHADOW = "document.querySelector('#picture').shadowRoot"


def row(path):
    return f'#tree [role=treeitem][data-path="{path}"] .node'


def has_class(selector, name, root="document"):
    return f"{root}.querySelector({json.dumps(selector)})?.classList.contains('{name}')"


def expect(actual, expected, what):
    if actual != expected:
        raise Failure(f"{what}: {actual!r}, not {expected!r}")


def open_row(page, path):
    page.click(row(path))
    page.until(f"document.querySelector('#tree [data-path=\"{path}\"]').getAttribute('aria-expanded') === 'true'")


def close_dialog(page):
    page.click("#set-close")
    page.until("!document.querySelector('#set').open")


def write_by_dialog(page, program):
    open_row(page, "Plant")
    open_row(page, "Plant.counter")
    page.click(row("Plant.counter.run"))
    page.click("#set-true")
    page.click("#set-write")
    program.wait_for("Plant.counter.run", "TRUE")
    program.wait_for("Plant.counter.count", "5")
    page.until("document.querySelector('#set-value').textContent === 'TRUE'")
    close_dialog(page)


def bad_value_in_dialog(page, program):
    page.click(row("Plant.divisor"))
    page.type("many")
    page.click("#set-write")
    page.until("document.querySelector('#set-error').textContent === '`many` is not a value of type INT'")
    expect(program.value("Plant.divisor"), "1", "after a bad value")
    close_dialog(page)


def force_and_unforce(page, program):
    page.click(row("Plant.divisor"))
    page.type("4")
    page.click("#set-force")
    until(lambda: program.forces() == {"Plant.divisor": "4"}, "the value is forced")
    program.wait_for("Plant.quotient", "25")
    page.until("document.querySelector('#forced-count').textContent === '1 value is forced'")
    close_dialog(page)
    page.click("#forced-list button")
    nothing_is_forced(page, program)


def nothing_is_forced(page, program):
    until(lambda: program.forces() == {}, "nothing is forced")
    page.until("document.querySelector('#forced').hidden")


def stop_cycle_start(page, program):
    page.click("#stop")
    program.wait_for_state("stopped")
    sum_before = int(program.value("Plant.sum"))
    page.click("#cycle")
    program.wait_for("Plant.sum", str(sum_before + 1))
    expect(program.state(), "stopped", "after one cycle")
    page.click("#start")
    program.wait_for_state("running")


def ladder(page, program):
    page.click("#tab-program")
    page.evaluate("choosePou('Starter')")
    page.until(f"{SHADOW}.querySelector('#e2')")
    page.until(has_class("#e2", "off", SHADOW))
    page.click("#e2", SHADOW)
    page.click("#set-true")
    page.click("#set-force")
    program.wait_for("Starter.motor", "TRUE")
    program.wait_for("Starter.late", "TRUE")
    close_dialog(page)
    for element in ("#e2", "#e4", "#e5", "#e13"):
        page.until(has_class(element, "on", SHADOW))
    page.until(f"{SHADOW}.querySelector('[data-from=\"11:ET\"] text.live').textContent === 'T#100ms'")
    page.click("#e4", SHADOW)
    page.click("#set-true")
    page.click("#set-write")
    program.wait_for("Starter.motor", "FALSE")
    close_dialog(page)
    page.until(has_class('[data-from="4"]', "off", SHADOW))
    page.click("#unforce-all")
    until(lambda: program.forces() == {}, "nothing is forced")


def chart(page, program):
    page.evaluate("choosePou('Chart')")
    page.until(has_class('[data-element="Idle"]', "on", SHADOW))
    page.click('[data-kind="transition"][data-path=".enable"]', SHADOW)
    page.click("#set-true")
    page.click("#set-write")
    program.wait_for("Chart.lamp", "TRUE")
    close_dialog(page)
    page.until(has_class('[data-element="Busy"]', "on", SHADOW))
    page.until(f"{SHADOW}.querySelector('[data-element=\"Busy\"] text.live').textContent.startsWith('T#')")
    expect(page.evaluate(has_class('[data-element="Idle"]', "on", SHADOW)), False, "the step before")


def text_and_fault(page, program):
    page.evaluate("choosePou('Plant')")
    page.until("[...document.querySelectorAll('#lines .chip')].some(chip => chip.textContent === 'divisor = 4')")
    page.until("[...document.querySelectorAll('#lines .chip')].some(chip => chip.textContent.includes('<b id='))")
    expect(page.evaluate("document.querySelector('#injected') === null"), True, "text of the program is no HTML")
    page.evaluate("[...document.querySelectorAll('#lines .chip')].find(chip => chip.textContent.startsWith('divisor')).id = 'divide'")
    page.click("#divide")
    page.type("0")
    page.press("Enter")
    program.wait_for_state("faulted")
    close_dialog(page)
    page.until("document.querySelector('#fault-text').textContent.includes('fault[div]')")
    page.click("#reset")
    program.wait_for_state("stopped")
    page.click("#start")
    program.wait_for("Plant.quotient", "100")
    page.until("document.querySelector('#fault').hidden")
    page.click("#tab-log")
    page.until("document.querySelector('#faults').textContent.includes('fault[div]')")


def watch_by_keys(page, program):
    page.press("1")
    page.press("/")
    page.until("document.activeElement.id === 'search'")
    page.type("most")
    page.until("document.querySelectorAll('#tree [role=treeitem]').length === 1")
    page.press("ArrowDown")
    page.press("w")
    field = '#watched tr[data-path="most"] input'
    page.click(field)
    page.type("7")
    page.press("Enter")
    program.wait_for("most", "7")
    page.until("document.querySelector('#watched tr[data-path=\"most\"] .value').textContent === '7'")
    page.call("Page.reload")
    page.until("document.querySelector('#watched tr[data-path=\"most\"] .value')?.textContent === '7'")
    page.click('#watched tr[data-path="most"] [data-act=Force]')
    until(lambda: program.forces() == {"most": "7"}, "the value is forced as it is")
    page.click('#watched tr[data-path="most"] [data-act=Unforce]')
    nothing_is_forced(page, program)


def record(page, program):
    page.click("#tab-scope")
    page.click("#scope-lane")
    page.type("Plant.sum")
    page.press("Enter")
    page.evaluate("document.querySelector('#scope-rows').value = 50")
    page.click("#scope-start")
    until(lambda: program.ask("/api/scope")["next"] > 60, "rows are recorded")
    expect(program.ask("/api/scope")["paths"], ["Plant.sum"], "what is recorded")
    page.click("#scope-stop")
    until(lambda: program.ask("/api/scope")["state"] == "complete", "the scope has stopped")
    page.until(f"scope.next === {program.ask('/api/scope')['next']}")
    lines = page.evaluate("csvOf()").splitlines()
    expect(lines[0], "time_ms,Plant.sum", "the head of the CSV")
    values = [int(line.split(",")[1]) for line in lines[1:]]
    expect(values, list(range(values[0], values[0] + len(values))), "no row is lost")
    data = program.ask("/api/scope/data")
    expect([str(value) for value in values[-len(data["times_ms"]):]], data["values"]["Plant.sum"], "the last rows")


def trigger(page, program):
    page.evaluate("document.querySelector('#scope-condition').value = 'rising';"
                  "document.querySelector('#scope-condition').dispatchEvent(new Event('change'))")
    page.click("#scope-path")
    page.type("Starter.start_button")
    page.evaluate("document.querySelector('#scope-before').value = 10")
    page.click("#scope-start")
    def waits():
        scope = program.ask("/api/scope")
        return scope["state"] == "waiting" and scope["next"] > 20
    until(waits, "rows are recorded before the trigger")
    program.ask("/api/write", {"values": {"Starter.start_button": "TRUE"}})
    until(lambda: program.ask("/api/scope")["state"] == "complete", "the trigger has come")
    page.until("scope.state === 'complete' && scope.trigger_ms !== null")
    scope = program.ask("/api/scope")
    expect(scope["trigger_row"] - scope["first"], 10, "rows before the trigger")
    page.click("#zoom-in")
    page.until("scope.to > scope.from")
    page.click("#lanes")
    page.press("ArrowRight")
    page.until("document.querySelector('#scope-cursor').textContent.includes('cursor at')")


def tasks_and_cold_reset(page, program):
    page.click("#tab-tasks")
    page.until("document.querySelector('#task-table tbody').textContent.includes('Main')")
    page.evaluate("document.querySelector('#reset-kind').value = 'cold'")
    page.click("#reset")
    until(lambda: program.value("most") == "5", "a cold reset sets initial values")


def new_body(page, program):
    """A version that has the same variables and another body: the page shows it."""
    page.evaluate("choosePou('Plant')")
    page.until("document.querySelector('#lines').textContent.includes('sum := sum + 1;')")
    with open("changed.iecst", "w", encoding="utf-8") as changed, open(os.path.join(HERE, "plant.iecst"), encoding="utf-8") as plant:
        changed.write(plant.read().replace("sum := sum + 1;", "sum := sum + 3;"))
    program.ask("/api/change", {"project": os.path.abspath("changed.iecst")})
    page.until("document.querySelector('#lines').textContent.includes('sum := sum + 3;')")


CHECKS = [write_by_dialog, bad_value_in_dialog, force_and_unforce, stop_cycle_start, ladder, chart, text_and_fault, watch_by_keys,
          record, trigger, tasks_and_cold_reset, new_body]


def main():
    with Program(os.path.join(HERE, "plant.iecst"), *sys.argv[1:]) as program, Page(program.url) as page:
        page.until("document.querySelector('#state').textContent === 'running'")
        for check in CHECKS:
            try:
                check(page, program)
            except Failure as failure:
                page.picture(os.environ.get("RUNG_PAGE_PICTURE", "failure.png"))
                print(f"{check.__name__}: {failure}")
                return 1
            print(f"{check.__name__}: ok")
        # A refused value is an answer of the monitor with a status of its own, which Chromium logs.
        errors = [error for error in page.errors if "status of 400" not in error]
        print("errors in the console:", errors or "none")
    return 0


if __name__ == "__main__":
    sys.exit(main())
