// SPDX-License-Identifier: MIT
/* The report: tabs, key figures, tables and figures, all built from the data in the page. A tab of
 * data.tabs describes itself: its controllers, groups of scenarios, measures, figures and the scene
 * that the player draws. */
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);

/* An element: make("p", {class: "note"}, "text", child, ...) */
function make(name, attributes = {}, ...children) {
    const element = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
        if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
        else if (value !== false && value != null) element.setAttribute(key, value === true ? "" : value);
    }
    element.append(...children.filter((child) => child != null));
    return element;
}

function number(value, digits) {
    return value == null ? "–" : value.toFixed(digits);
}

const seriesColour = (tab, image) => `var(--c${tab.images.find((one) => one.id === image).colour})`;
const runOf = (tab, image, scenario) => tab.runs[`${image}/${scenario}`];
const isPlayable = (tab, scenario) => tab.images.some((image) => runOf(tab, image.id, scenario)?.trace);
const groupOf = (tab, scenario) => tab.groups.find((group) => group.scenarios.includes(scenario));

/* --- figures ---------------------------------------------------------------------------------- */

function figure(tab, block, item) {
    const element = make("figure"), images = tab.images.filter((image) => item.images.includes(image.id));
    element.innerHTML = figures[block.kind](tab, block, images, item.rows);
    if (item.caption) element.append(make("figcaption", {}, item.caption));
    return element;
}

/* --- key figures --------------------------------------------------------------------------------- */

function tileValue(tab, image, tile) {
    if (tile.kind === "met" || tile.kind === "impacts") {
        /* Of the scenarios that all ran, so that the numbers compare; of its own where there are none. */
        const listed = tab.groups.filter((group) => group.listed).flatMap((group) => group.scenarios);
        const common = listed.filter((scenario) => tab.images.every((one) => runOf(tab, one.id, scenario)));
        const runs = (common.length ? common : listed).map((scenario) => runOf(tab, image, scenario)).filter((run) => run);
        return `${runs.filter((run) => (tile.kind === "met" ? run.met : run.values?.impact_mps > 0)).length} of ${runs.length}`;
    }
    if (tile.kind === "sensor") {
        /* The image's identity names any sensor but the ultrasonic one. */
        const who = tab.images.find((one) => one.id === image).who;
        return who === "" ? "–" : (/ Hz (\w+) table=/.exec(who)?.[1] ?? "hcsr04");
    }
    if (tile.kind === "limit") {
        /* The highest of the rising values in a group's names up to which all was well. */
        let best = null;
        for (const scenario of tab.groups.find((group) => group.id === tile.argument)?.scenarios ?? []) {
            const run = runOf(tab, image, scenario);
            if (!run?.ok || run.values.impact_mps > 0) break;
            best = Number(scenario.split("_")[1]);
        }
        return best == null ? "–" : `${best.toFixed(tile.digits)} ${tile.unit}`;
    }
    const run = runOf(tab, image, tile.argument);
    return run?.ok && run.values[tile.kind] != null ? `${number(run.values[tile.kind], tile.digits)} ${tile.unit}` : "–";
}

function tiles(tab) {
    return make("div", { class: "tiles" }, ...tab.images.map((image) =>
        make("section", { class: "tile", style: `--series:${seriesColour(tab, image.id)}` },
            make("h3", {}, image.name), make("p", { class: "who" }, image.who),
            make("dl", {}, ...tab.tiles.flatMap((tile) =>
                [make("dt", {}, tile.name), make("dd", {}, tileValue(tab, image.id, tile))])))));
}

/* --- the table of all runs -------------------------------------------------------------------------- */

function cell(run, measure, first) {
    const value = run?.values?.[measure.key];
    const place = `measure measure-${measure.index}${first ? " first" : ""}`;
    if (!run) return make("td", { class: `${place} gone`, title: "not run" }, "");
    if (!run.ok) return make("td", { class: `${place} lost`, title: "this run failed" }, "failed");
    const hit = measure.key === "impact_mps" && value > 0, unmet = measure.index === 0 && !run.met ? " unmet" : "";
    if (measure.key === "impact_mps" && !hit) return make("td", { class: `${place}${unmet} gone` }, "none");
    return make("td", { class: `${place}${unmet}${hit ? " hit" : value == null ? " gone" : ""}` }, number(value, measure.digits));
}

function table(tab, show) {
    const many = tab.images.length > 1;
    const head = make("thead");
    const measures = tab.measures.map((measure, index) => ({ ...measure, index }));
    head.append(make("tr", {}, make("th", {}, ""), ...measures.map((measure) =>
        make("th", { class: `measure measure-${measure.index} first`, colspan: tab.images.length },
            `${measure.name}${measure.unit ? ", " + measure.unit : ""}`))));
    if (many)
        head.append(make("tr", {}, make("th", {}, ""), ...measures.flatMap((measure) => tab.images.map((image, k) =>
            make("th", { class: `series measure measure-${measure.index}${k ? "" : " first"}`, style: `--series:${seriesColour(tab, image.id)}`, title: image.name },
                image.short)))));
    const body = make("tbody");
    for (const group of tab.groups.filter((one) => one.listed && one.scenarios.length)) {
        body.append(make("tr", { class: "group" }, make("th", { colspan: 1 + tab.images.length * measures.length, scope: "rowgroup" }, group.title)));
        for (const scenario of group.scenarios) {
            const info = tab.scenarios[scenario], playable = isPlayable(tab, scenario);
            body.append(make("tr", { class: playable ? "run" : "", "data-scenario": scenario, onclick: playable ? () => show(scenario) : () => {} },
                make("th", { scope: "row" }, playable ? make("button", { type: "button", class: "row" }, info.title) : info.title,
                    make("span", { class: "note" }, ` owed: ${info.owed}`)),
                ...measures.flatMap((measure) => tab.images.map((image, k) => cell(runOf(tab, image.id, scenario), measure, k === 0)))));
        }
    }
    const whole = make("table", { class: "grouped", "data-measure": "0" }, head, body);
    const choice = make("select", { class: "only", "aria-label": "measure", onchange: () => { whole.dataset.measure = choice.value; } },
        ...measures.map((measure) => make("option", { value: measure.index }, `${measure.name}${measure.unit ? ", " + measure.unit : ""}`)));
    return make("section", { class: "card" }, make("h2", {}, "All runs"),
        make("p", { class: "note" }, "Choose a row to replay it. ", make("span", { class: "unmet" }, "something owed is not met.")), choice, make("div", { class: "scroll" }, whole));
}

/* What a publication says, and what came out here. */
function publishedTable(tab) {
    const rows = tab.published.filter((row) => tab.images.some((image) => runOf(tab, image.id, row.scenario)?.ok));
    if (!rows.length) return null;
    const ours = (row, image) => {
        const run = runOf(tab, image.id, row.scenario), value = run?.ok ? run.values[row.measure] : null;
        if (!run) return make("td", { class: "gone" }, "not run");
        const hits = row.measure !== "impact_mps" && run.values?.impact_mps > 0;
        if (hits && !(value > 0)) return make("td", { class: "hit" }, "impact");
        const far = Number(row.said) ? `, ${value < row.said ? "−" : "+"}${number(Math.abs(value - row.said), row.digits)}` : "";
        return make("td", {}, value == null ? "–" : `${number(value, row.digits)} ${row.unit}${far}${hits ? ", then impact" : ""}`);
    };
    return make("section", { class: "card" }, make("h2", {}, "Published, and here"),
        make("p", { class: "note" }, "The publication's figure, then what the image does on the same case, and how far that is from the figure."),
        make("div", { class: "scroll" }, make("table", { class: "published" },
            make("thead", {}, make("tr", {}, make("th", {}, ""), make("th", {}, "published"), ...tab.images.map((image) => make("th", { class: "series", style: `--series:${seriesColour(tab, image.id)}` }, image.name)))),
            make("tbody", {}, ...rows.map((row) => make("tr", {}, make("th", { scope: "row" }, row.name), make("td", {}, Number(row.said) ? `${row.said} ${row.unit}` : row.said), ...tab.images.map((image) => ours(row, image))))))));
}

/* What stands above all tabs: drives that came out differently in the two engines. */
function disagreements() {
    if (!data.disagree.length) return null;
    return make("section", { class: "card broken" }, make("h2", {}, "The two engines disagree"),
        make("p", {}, "These drives came out differently in s51, so the page cannot be trusted before the reason is found."),
        make("ul", {}, ...data.disagree.map((text) => make("li", {}, text))));
}

/* --- a tab ------------------------------------------------------------------------------------------- */

function failures(tab) {
    const lost = Object.entries(tab.runs).filter(([, run]) => !run.ok);
    if (!lost.length) return null;
    return make("section", { class: "card broken" }, make("h2", {}, `${lost.length} failed run${lost.length > 1 ? "s" : ""}`),
        make("p", {}, "These runs did not come to an end, so they say nothing about the controller. ‘make report’ tries them again."),
        make("ul", {}, ...lost.slice(0, 20).map(([name, run]) => make("li", {}, `${name}: ${run.error}`))),
        lost.length > 20 ? make("p", {}, `and ${lost.length - 20} more`) : null);
}

function runTab(tab) {
    const panel = make("div");
    const player = Object.keys(tab.scenarios).some((scenario) => isPlayable(tab, scenario)) ? makePlayer(tab) : null;
    const all = table(tab, (scenario) => {
        player.show(scenario);
        player.element.scrollIntoView({ behavior: "smooth", block: "start" });
    });
    panel.append(...tab.about.map((text) => make("p", {}, text)));
    const lost = failures(tab);
    if (lost) panel.append(lost);
    if (tab.tiles.length) panel.append(tiles(tab));
    if (player) panel.append(player.element);
    const yourself = tab.yourself && Object.keys(tab.yourself.hex).length ? makeYourself(tab) : null;
    if (yourself) panel.append(yourself.element);
    panel.append(publishedTable(tab) ?? "");
    for (const block of tab.figures)
        panel.append(make("section", { class: "card" }, make("h2", {}, block.title), make("p", { class: "note" }, block.caption),
            make("div", { class: block.wide ? "figures wide" : "figures" }, ...block.items.map((item) => figure(tab, block, item)))));
    panel.append(all);
    if (player)
        player.onshow = (scenario) => all.querySelectorAll("tr.run").forEach((row) => row.classList.toggle("chosen", row.dataset.scenario === scenario));
    return { panel, player, yourself };
}

/* A tab of tables. */
function sheetsTab(about, sheets) {
    const panel = make("div", {}, make("p", {}, about));
    for (const sheet of sheets)
        panel.append(make("section", { class: "card" }, make("h2", {}, sheet.title), make("p", { class: "note" }, sheet.caption),
            make("div", { class: "scroll" }, make("table", {},
                make("thead", {}, make("tr", {}, ...sheet.head.map((text) => make("th", {}, text)))),
                make("tbody", {}, ...sheet.rows.map((row) => make("tr", {}, ...row.map((text) => make("td", {}, text)))))))));
    return { panel, player: null, yourself: null };
}

function boardsTab() {
    const tab = sheetsTab("What each controller takes on each board that holds it, as the linker and the simulator count it.", data.sheets);
    for (const text of data.texts)
        tab.panel.append(make("section", { class: "card" }, make("h2", {}, text.title), make("p", { class: "note" }, text.caption),
            make("pre", { class: "scroll" }, text.body)));
    return tab;
}

function coverageTab() {
    return sheetsTab("What of the firmware the tests reach. make test fails if anything is left without a reason.", data.coverage);
}

const tabs = [];

function openTab(chosen) {
    for (const tab of tabs) {
        const on = tab === chosen;
        tab.button.setAttribute("aria-selected", on);
        tab.button.tabIndex = on ? 0 : -1;
        if (on && !tab.content) {
            tab.content = tab.build();
            tab.content.panel.setAttribute("role", "tabpanel");
            document.getElementById("main").append(tab.content.panel);
        }
        if (tab.content) {
            tab.content.panel.hidden = !on;
            if (on) tab.content.player?.draw();
            else tab.content.player?.pause();
            if (on) tab.content.yourself?.draw();
            else tab.content.yourself?.stop();
        }
    }
}

function start() {
    const root = document.documentElement, theme = document.getElementById("theme");
    const dark = () => root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    const name = () => { theme.textContent = dark() ? "light" : "dark"; };
    theme.addEventListener("click", () => { root.dataset.theme = dark() ? "light" : "dark"; name(); });
    name();
    document.getElementById("made").textContent = data.made;
    document.getElementById("main").append(disagreements() ?? "");

    for (const tab of data.tabs) tabs.push({ id: tab.id, title: tab.title, build: () => runTab(tab) });
    tabs.push({ id: "boards", title: "Boards", build: boardsTab });
    tabs.push({ id: "coverage", title: "Coverage", build: coverageTab });
    for (const tab of tabs) {
        tab.button = make("button", { type: "button", role: "tab", onclick: () => { openTab(tab); history.replaceState(null, "", `#${tab.id}`); } }, tab.title);
        document.getElementById("tabs").append(tab.button);
    }
    document.getElementById("tabs").addEventListener("keydown", (event) => {
        const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key], at = tabs.findIndex((tab) => tab.button === event.target);
        if (!step || at < 0) return;
        const next = tabs[(at + step + tabs.length) % tabs.length];
        next.button.focus();
        next.button.click();
    });
    openTab(tabs.find((tab) => `#${tab.id}` === location.hash) ?? tabs[0]);
}

start();
if (location.hash === "#selftest") selfTest();
