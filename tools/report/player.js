// SPDX-License-Identifier: MIT
/* The player: replays recorded runs of one tab. The state is the scenario, the controller and the
 * moment; every frame is drawn from them anew. */
"use strict";

/* Index of the last moment not after t_s. */
function indexAt(times, t_s) {
    let low = 0, high = times.length - 1;
    while (low < high) {
        const middle = (low + high + 1) >> 1;
        if (times[middle] <= t_s) low = middle;
        else high = middle - 1;
    }
    return low;
}

/* All columns of a trace at t_s: numbers between two records are interpolated where both exist,
 * words and switches keep the earlier one. */
function momentOf(tab, trace, t_s) {
    const at = {}, k = indexAt(trace.t, t_s), next = Math.min(k + 1, trace.t.length - 1);
    const span = trace.t[next] - trace.t[k], part = span > 0 ? Math.min(1, (t_s - trace.t[k]) / span) : 0;
    for (const column of tab.columns) {
        const values = trace[column.key];
        if (!values) continue;
        const a = values[k], b = values[next];
        if (column.words) at[column.key] = a == null ? null : column.words[a];
        else {
            const turned = column.unit === "°" && Math.abs(b - a) > 180; /* from 180 to -180 */
            at[column.key] = !column.steps && !turned && a != null && b != null ? a + (b - a) * part : a;
        }
    }
    at.t_s = t_s;
    return at;
}

/* The way that a car with these speeds has driven at each moment, in metres. */
function wayOf(times, speeds) {
    const way = [0];
    for (let k = 1; k < times.length; k++)
        way.push(way[k - 1] + (speeds[k] + speeds[k - 1]) / 2 * (times[k] - times[k - 1]));
    return way;
}

function makePlayer(tab) {
    const playable = tab.groups.flatMap((group) => group.scenarios)
        .filter((scenario) => isPlayable(tab, scenario));
    const first = tab.first && playable.includes(tab.first) ? tab.first : playable[0];
    const state = { scenario: first, image: tab.images[0].id, all: false, t_s: 0, end_s: 1, playing: false, speed: 1, last_ms: 0 };
    const player = { element: null, show, draw, pause, state, onshow: null };

    /* --- controls --- */
    const scenarios = make("select", { class: "scenario", "aria-label": "scenario", onchange: () => show(scenarios.value) },
        ...tab.groups.filter((group) => group.scenarios.some((one) => playable.includes(one))).map((group) =>
            make("optgroup", { label: group.title }, ...group.scenarios.filter((one) => playable.includes(one)).map((scenario) =>
                make("option", { value: scenario }, tab.scenarios[scenario].title)))));
    const chips = tab.images.map((image) =>
        make("button", { type: "button", style: `--series:${seriesColour(tab, image.id)}`, "data-image": image.id, onclick: () => { state.all = false; choose(image.id); } }, image.name));
    const together = tab.images.length > 1 && tab.scene.together
        ? make("button", { type: "button", style: "--series:var(--soft)", onclick: () => { state.all = !state.all; refresh(); } }, "all at once") : null;
    const play = make("button", { type: "button", class: "play", onclick: () => (state.playing ? pause() : start()) }, "▶ play");
    const slider = make("input", { type: "range", min: 0, max: 1000, value: 0, step: 1, "aria-label": "time",
        oninput: () => { pause(); state.t_s = slider.value / 1000 * state.end_s; draw(); } });
    const clock = make("output", {}, "");
    const speed = make("select", { "aria-label": "speed of the replay", onchange: () => { state.speed = Number(speed.value); } },
        ...[["0.1", "1/10"], ["0.25", "1/4"], ["1", "1 ×"], ["4", "4 ×"], ["16", "16 ×"]].map(([value, name]) => make("option", { value, selected: value === String(tab.scene.speed) }, name)));
    state.speed = tab.scene.speed;

    /* --- what is shown --- */
    const scene = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    scene.setAttribute("class", "scene");
    scene.setAttribute("role", "img");
    const readout = make("div", { class: "readout" });
    const outcome = make("ul", { class: "outcome" });
    const cursor = make("div", { class: "cursor" });
    const drawing = make("figure");
    const legend = [tab.images.length > 1 ? "Faint: the other controllers." : "", tab.scene.speedColumn ? "Dashed: the speed of the car ahead." : ""].join(" ").trim();
    const trace = make("div", { class: "trace" }, drawing, cursor);

    player.element = make("section", { class: "card player" }, make("h2", {}, "Replay"),
        make("div", { class: "pick" }, scenarios), make("div", { class: "pick chips" }, ...chips, together), scene,
        make("div", { class: "transport" }, play, slider, clock, speed), readout, outcome, trace,
        make("p", { class: "note" }, legend));

    const shown = () => (state.all ? tab.images.map((image) => image.id) : [state.image])
        .map((image) => ({ image, run: runOf(tab, image, state.scenario) })).filter((one) => one.run?.trace);

    function choose(image) {
        state.image = image;
        refresh();
    }

    /* A new scenario or controller: the controls, the trace, the outcome; then the frame. */
    function refresh() {
        chips.forEach((chip) => {
            chip.disabled = !runOf(tab, chip.dataset.image, state.scenario)?.trace;
            chip.setAttribute("aria-pressed", !state.all && chip.dataset.image === state.image);
        });
        together?.setAttribute("aria-pressed", state.all);
        const ends = tab.images.map((image) => runOf(tab, image.id, state.scenario)?.trace?.t.at(-1) ?? 0);
        state.end_s = Math.max(...ends, 0.001);
        state.t_s = Math.min(state.t_s, state.end_s);
        drawing.innerHTML = traceFigure(tab, state.scenario);
        trace.hidden = !drawing.innerHTML;
        dim();
        const run = runOf(tab, state.image, state.scenario);
        outcome.replaceChildren(...(run?.expect ?? []).filter((one) => one.text !== "impact = any").map((one) =>
            make("li", { class: one.met ? "met" : "unmet" }, `${one.text} (${one.value})`)));
        draw();
    }

    /* In the trace, what belongs to other controllers steps back. */
    function dim() {
        tab.images.forEach((image) => drawing.querySelectorAll(`[stroke="${seriesColour(tab, image.id)}"]`)
            .forEach((path) => path.classList.toggle("other", !state.all && image.id !== state.image)));
    }

    function show(scenario) {
        pause();
        state.scenario = scenario;
        state.t_s = 0;
        scenarios.value = scenario;
        if (!runOf(tab, state.image, scenario)?.trace)
            state.image = tab.images.find((image) => runOf(tab, image.id, scenario)?.trace).id;
        refresh();
        player.onshow?.(scenario);
    }

    function draw() {
        const runs = shown().map(({ image, run }) => {
            const end_s = run.trace.t.at(-1), t_s = Math.min(state.t_s, end_s);
            const speeds = run.trace[tab.scene.speedColumn];
            run.way ??= speeds ? wayOf(run.trace.t, speeds) : null;
            const at = momentOf(tab, run.trace, t_s), k = indexAt(run.trace.t, t_s);
            if (run.way) at.x_m = run.way[k] + speeds[k] * (t_s - run.trace.t[k]);
            const { name, short } = tab.images.find((one) => one.id === image);
            return { name, short, colour: seriesColour(tab, image), at, trace: run.trace,
                ended: state.t_s >= end_s, impact: run.values?.impact_mps ?? 0, chosen: image === state.image };
        });
        const width = Math.max(300, scene.clientWidth || 700);
        const picture = scenes[tab.scene.name]({ ...tab.scene, width, info: tab.scenarios[state.scenario] }, runs);
        scene.setAttribute("viewBox", `0 0 ${width} ${picture.height}`);
        scene.setAttribute("height", picture.height);
        scene.innerHTML = picture.svg;
        scene.setAttribute("aria-label", `${tab.scenarios[state.scenario].title}, ${state.t_s.toFixed(2)} s`);
        slider.value = Math.round(state.t_s / state.end_s * 1000);
        clock.textContent = `${state.t_s.toFixed(2)} s`;
        const mine = runs.find((run) => run.chosen) ?? runs[0];
        readout.replaceChildren(...tab.columns.filter((column) => column.shown).map((column) => {
            const value = mine?.at[column.key];
            return make("div", {}, make("span", {}, column.name),
                make("b", {}, value == null || value === "" ? "–" : typeof value === "number" ? `${value.toFixed(column.digits)} ${column.unit}` : value));
        }));
        const { left, right } = traceMargins;
        cursor.style.left = `${(left + (right - left) * state.t_s / state.end_s) * 100}%`;
        cursor.style.top = "2%";
        cursor.style.bottom = "8%";
    }

    function start() {
        if (state.t_s >= state.end_s) state.t_s = 0;
        state.playing = true;
        state.last_ms = 0;
        play.textContent = "❚❚ pause";
        requestAnimationFrame(step);
    }

    function pause() {
        state.playing = false;
        play.textContent = "▶ play";
    }

    function step(now_ms) {
        if (!state.playing) return;
        if (state.last_ms) state.t_s = Math.min(state.end_s, state.t_s + (now_ms - state.last_ms) / 1000 * state.speed);
        state.last_ms = now_ms;
        draw();
        if (state.t_s >= state.end_s) pause();
        else requestAnimationFrame(step);
    }

    let drawn_px = 0;
    new ResizeObserver(() => {
        if (scene.clientWidth === drawn_px) return;
        drawn_px = scene.clientWidth;
        requestAnimationFrame(draw);
    }).observe(player.element);
    show(state.scenario);
    return player;
}
