// SPDX-License-Identifier: MIT
/* index.html#selftest goes through everything that a reader can touch and writes what it found into
 * the root element's data-selftest: "passed: N checks, ..." or "failed: ...", with a list of faults at the
 * end of the page; a page around it gets the same as a message. Errors of any origin count, so the
 * handlers come first in the page's script. */
"use strict";

const pageErrors = [];
addEventListener("error", (event) => pageErrors.push(`error: ${event.message}`));
addEventListener("unhandledrejection", (event) => pageErrors.push(`rejection: ${event.reason}`));

function selfTest() {
    const faults = [];
    const compared = [];
    let checks = 0;
    const check = (good, what) => { checks++; if (!good) faults.push(what); };
    const clean = (text) => !/NaN|undefined|Infinity/.test(text);
    const move = (slider, value) => { slider.value = value; slider.dispatchEvent(new Event("input", { bubbles: true })); };

    for (const tab of tabs) {
        tab.button.click();
        const panel = tab.content.panel;
        check(!panel.hidden && tabs.every((one) => one === tab || !one.content || one.content.panel.hidden), `${tab.id}: alone in sight`);
        check(document.documentElement.scrollWidth <= innerWidth, `${tab.id}: ${document.documentElement.scrollWidth} px wide in a window of ${innerWidth}`);
        for (const one of panel.querySelectorAll("table"))
            check(one.scrollWidth <= one.parentElement.clientWidth, `${tab.id}: a table of ${one.scrollWidth} px in ${one.parentElement.clientWidth}`);
        for (const one of panel.querySelectorAll("figure"))
            check(one.closest(".trace") || one.querySelector("svg"), `${tab.id}: a figure is missing`);
        const player = tab.content.player, description = data.tabs.find((one) => one.id === tab.id);
        check(!description || player, `${tab.id}: no player`);
        if (player) testPlayer(tab, description, player);
        check(clean(panel.textContent), `${tab.id}: NaN or undefined in the text`);
    }
    tabs[0].button.click();
    for (const tab of tabs) if (tab.content.yourself) testYourself(tab, data.tabs.find((one) => one.id === tab.id), tab.content.yourself);

    /* The chip in the page drives the tab's scenario as drive did. Then one drive with its buttons. */
    function testYourself(tab, description, yourself) {
        chip.load();
        for (const image of Object.keys(description.yourself.hex)) {
            const run = runOf(description, image, description.yourself.like), outcome = driveWhole(description, image);
            check(!outcome.fault, `${tab.id}: ${image}: ${outcome.fault}`);
            if (!run?.ok) continue;
            for (const [key, value] of Object.entries(run.values)) {
                check(Math.abs(outcome[key] - value) < 1e-3, `${tab.id}: ${image}: ${key} is ${outcome[key]} in the page, ${value} by drive`);
                compared.push(`${image} ${key} ${outcome[key].toFixed(3)}`);
            }
        }
        yourself.start();
        check(yourself.state.driving, `${tab.id}: does not drive: ${yourself.outcome.textContent}`);
        for (let k = 0; k < 30; k++) yourself.step(1000 + 16 * k);
        check(yourself.state.row.t_s >= 0.46 && yourself.state.row.t_s < 0.5, `${tab.id}: ${yourself.state.row.t_s} s after 464 ms`);
        yourself.brakes.dispatchEvent(new Event("pointerdown"));
        check(yourself.brakes.getAttribute("aria-pressed") === "true", `${tab.id}: the car ahead cannot be told to brake`);
        yourself.brakes.dispatchEvent(new Event("pointerup"));
        check(yourself.state.row.t_s > 0 && clean(yourself.element.textContent) && clean(yourself.element.innerHTML), `${tab.id}: the own drive is broken`);
        yourself.stop();
        check(yourself.outcome.textContent !== "" && clean(yourself.outcome.textContent), `${tab.id}: no outcome of the own drive`);
    }

    function testPlayer(tab, description, player) {
        const root = player.element, slider = root.querySelector("input[type=range]"), scene = root.querySelector("svg.scene");
        const clock = root.querySelector(".transport output"), choice = root.querySelector("select.scenario");
        let moved = 0;
        for (const option of choice.options) {
            choice.value = option.value;
            choice.dispatchEvent(new Event("change"));
            for (const chip of root.querySelectorAll(".chips button")) {
                if (chip.disabled) continue;
                chip.click();
                const frames = [0, 333, 1000].map((value) => {
                    move(slider, value);
                    const wanted = `${(value / 1000 * player.state.end_s).toFixed(2)} s`, place = `${tab.id}: ${option.value}, ${chip.textContent}, ${value}`;
                    check(clock.textContent === wanted, `${place}: the clock shows ${clock.textContent}, not ${wanted}`);
                    check(scene.childElementCount > 0 && clean(scene.innerHTML), `${place}: the scene is empty or broken`);
                    return scene.innerHTML;
                });
                if (frames[0] !== frames[2]) moved++;
            }
        }
        check(moved > 0, `${tab.id}: nothing moves`);
        const play = root.querySelector(".play");
        move(slider, 0);
        play.click();
        check(player.state.playing, `${tab.id}: does not play`);
        play.click();
        check(!player.state.playing, `${tab.id}: does not pause`);
        const all = tab.content.panel.querySelectorAll("tr[data-scenario]");
        check(all.length === description.groups.filter((group) => group.listed).reduce((sum, group) => sum + group.scenarios.length, 0), `${tab.id}: ${all.length} rows`);
        const rows = tab.content.panel.querySelectorAll("tr.run");
        const last = rows[rows.length - 1];
        last.click();
        check(player.state.scenario === last.dataset.scenario, `${tab.id}: a row does not choose its scenario`);
        show(player, description);
    }

    function show(player, description) {
        player.show(description.first in description.scenarios ? description.first : player.state.scenario);
    }

    faults.push(...pageErrors);
    document.documentElement.dataset.selftest = `${faults.length ? "failed" : "passed"}: ${checks} checks, ${faults.length} faults, ${innerWidth} px wide; chip: ${compared.join(", ") || "nothing compared"}`;
    if (parent !== window) parent.postMessage([document.documentElement.dataset.selftest, ...faults.slice(0, 5)].join("; "), "*");
    document.body.append(make("pre", { id: "selftest" }, faults.slice(0, 50).join("\n")));
}
