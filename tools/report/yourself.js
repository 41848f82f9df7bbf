// SPDX-License-Identifier: MIT
/* Drive it yourself: the real image in drive's own simulator, both compiled to WebAssembly
 * (tools/report/wasm), with the settings of the reader and a car ahead that obeys two buttons. */
"use strict";

const chip = {
    exports: null,

    /* Makes the simulator ready; it is small enough to be compiled at once. */
    load() {
        if (chip.exports) return;
        const bytes = Uint8Array.from(atob(document.getElementById("chip").textContent.trim()), (c) => c.charCodeAt(0));
        const nothing = new Proxy({}, { get: () => () => 0 }); /* what a program may ask of a system */
        chip.exports = new WebAssembly.Instance(new WebAssembly.Module(bytes), { wasi_snapshot_preview1: nothing }).exports;
        chip.exports._initialize();
    },
    put(text) {
        const bytes = new TextEncoder().encode(`${text}\0`), at = chip.exports.page_text(bytes.length);
        new Uint8Array(chip.exports.memory.buffer).set(bytes, at);
        return at;
    },
    take(at) {
        const bytes = new Uint8Array(chip.exports.memory.buffer, at);
        return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
    },
    /* Returns what was wrong, or "". */
    begin: (hex, board, settings) => (chip.exports.page_begin(chip.put(hex), chip.put(board), chip.put(settings.join("\n"))) ? "" : chip.take(chip.exports.page_said())),
    next: () => chip.exports.page_next() !== 0,
    lead: (accel_mps2, top_mps) => chip.exports.page_lead(accel_mps2, top_mps),
    row: () => JSON.parse(chip.take(chip.exports.page_row())),
    outcome: () => JSON.parse(chip.take(chip.exports.page_outcome())),
};

/* The outcome of the tab's own scenario, as it stands in its file, driven by that controller. */
function driveWhole(tab, image) {
    const { hex, board, settings } = tab.yourself, fault = chip.begin(hex[image], board, settings);
    if (fault) return { fault };
    while (chip.next());
    return chip.outcome();
}

function tellOutcome(outcome, row) {
    const the = (key) => number(outcome[key], 2), decel = `peak deceleration ${the("peak_decel_mps2")} m/s²`;
    if (outcome.impact_mps > 0) return `Impact at ${the("impact_mps")} m/s after ${row.t_s.toFixed(2)} s; ${decel}.`;
    if (outcome.final_speed_mps > 0) return `Still drives, at ${the("final_speed_mps")} m/s; smallest gap ${the("min_gap_m")} m, ${decel}.`;
    return `Stopped ${the("stop_gap_m")} m behind the car ahead after ${the("rest_s")} s; ${decel}.`;
}

function makeYourself(tab) {
    const longest_s = 120, stands_s = 2, rowsPerPoint = 2;
    const images = tab.images.filter((image) => tab.yourself.hex[image.id]);
    const state = { image: images[0], driving: false, begun_ms: 0, row: null, trace: null, rows: 0, stood_s: 0, pedal: 0, impact: 0, frames: 0, ended: false };

    /* --- controls --- */
    const settings = Object.fromEntries(tab.yourself.settings.map((text) => text.split(/ *= *(.*)/)));
    const knobs = tab.yourself.knobs.map((knob) => {
        const digits = knob.step < 0.1 ? 2 : knob.step < 1 ? 1 : 0;
        const slider = make("input", { type: "range", min: knob.low, max: knob.high, step: knob.step, value: settings[knob.setting] ?? knob.value, "aria-label": knob.name, oninput: () => { show(); if (!state.driving) rest(); } });
        const value = make("output", {}, "");
        const show = () => { value.textContent = `${Number(slider.value).toFixed(digits)} ${knob.unit}`; };
        show();
        return { ...knob, slider, element: make("label", {}, make("span", {}, knob.name), value, slider) };
    });
    const knobValue = (setting) => Number(knobs.find((knob) => knob.setting === setting).slider.value);
    const chips = images.map((image) => make("button", { type: "button", style: `--series:${seriesColour(tab, image.id)}`, onclick: () => { stop(); state.image = image; rest(); } }, image.name));
    const drive = make("button", { type: "button", class: "play", onclick: () => (state.driving ? stop() : start()) }, "▶ drive");
    const brakes = pedal("it brakes", () => -knobValue("pedal")), drivesOn = pedal("it drives on", () => 2);
    const clock = make("output", {}, "0.00 s");

    /* --- what is shown --- */
    const scene = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    scene.setAttribute("class", "scene");
    scene.setAttribute("role", "img");
    scene.setAttribute("aria-label", "your own drive");
    const readout = make("div", { class: "readout" });
    const outcome = make("p", { class: "told", "aria-live": "polite" }, "");
    const drawing = make("figure"), trace = make("div", { class: "trace", hidden: true }, drawing);
    const element = make("section", { class: "card yourself" }, make("h2", {}, "Drive it yourself"),
        make("p", { class: "note" }, `The hex file of the board ${tab.yourself.board}, unchanged, runs in real time here in your browser, in the same cycle-exact simulator and on the same road as in all drives of this page. Set the scene and drive; hold a button to make the car ahead brake or drive on.`),
        make("div", { class: "pick chips" }, ...chips), make("div", { class: "knobs" }, ...knobs.map((knob) => knob.element)), scene,
        make("div", { class: "transport" }, drive, make("span", { class: "ahead" }, "The car ahead:"), brakes, drivesOn, clock), readout, outcome, trace);

    /* A button that acts as long as it is held. */
    function pedal(name, accel_mps2) {
        const press = (event) => {
            if (event.type === "keydown" && (event.repeat || ![" ", "Enter"].includes(event.key))) return;
            event.preventDefault();
            if (!state.driving) return;
            state.pedal = accel_mps2();
            chip.lead(state.pedal, longestSpeed());
            button.setAttribute("aria-pressed", true);
        };
        const release = () => {
            if (button.getAttribute("aria-pressed") !== "true") return;
            button.setAttribute("aria-pressed", false);
            state.pedal = 0;
            if (state.driving) chip.lead(0, 0);
        };
        const button = make("button", { type: "button", class: "pedal", disabled: true, "aria-pressed": false, onpointerdown: press, onkeydown: press,
            onpointerup: release, onpointerleave: release, onpointercancel: release, onkeyup: release, onblur: release, oncontextmenu: (event) => event.preventDefault() }, name);
        return button;
    }
    const longestSpeed = () => Math.max(...knobs.filter((knob) => knob.setting.endsWith("speed_mps")).map((knob) => knob.high));

    function take() {
        const row = chip.row();
        for (const column of tab.columns)
            if (column.source !== column.key) row[column.key] = row[column.source] == null ? null : row[column.source] * column.factor + column.offset;
        row.x_m = (state.row?.x_m ?? 0) + row.ego_mps * (row.t_s - (state.row?.t_s ?? 0));
        state.stood_s = row.ego_mps > 0 || row.lead_mps > 0 || state.pedal > 0 ? 0 : state.stood_s + row.t_s - (state.row?.t_s ?? 0);
        state.row = row;
        if (state.rows++ % rowsPerPoint) return;
        state.trace.t.push(row.t_s);
        for (const panel of tab.panels)
            for (const key of [panel.column, panel.reference].filter((one) => one)) state.trace[key].push(row[key] ?? null);
    }

    /* The scene before a drive, from the controls alone. */
    function rest() {
        state.row = { gap_m: knobValue("lead.gap_m"), ego_mps: knobValue("ego.speed_mps"), lead_mps: knobValue("lead.speed_mps"), brake_pct: 0, x_m: 0, t_s: 0, state: "" };
        state.impact = 0;
        state.ended = false;
        outcome.textContent = "";
        trace.hidden = true;
        draw();
    }

    function start() {
        chip.load();
        const wanted = [...tab.yourself.settings, ...knobs.filter((knob) => knob.setting !== "pedal").map((knob) => `${knob.setting}=${knob.slider.value}`),
            "scenario.hold_s=3600", `scenario.duration_s=${longest_s}`];
        const fault = chip.begin(tab.yourself.hex[state.image.id], tab.yourself.board, wanted);
        if (fault) {
            outcome.textContent = fault;
            return;
        }
        rest();
        Object.assign(state, { driving: true, begun_ms: 0, row: null, rows: 0, stood_s: 0, pedal: 0, frames: 0 });
        state.trace = Object.fromEntries(["t", ...tab.panels.flatMap((panel) => [panel.column, panel.reference])].filter((key) => key).map((key) => [key, []]));
        take();
        drive.textContent = "■ stop";
        brakes.disabled = drivesOn.disabled = false;
        requestAnimationFrame(step);
    }

    function stop() {
        if (!state.driving) return;
        const result = chip.outcome();
        state.driving = false;
        state.impact = result.impact_mps;
        state.ended = true;
        drive.textContent = "▶ drive";
        brakes.disabled = drivesOn.disabled = true;
        outcome.textContent = tellOutcome(result, state.row);
        draw();
        drawTrace();
    }

    /* As much simulated time as has passed; a page that was out of sight goes on where it was. */
    function step(now_ms) {
        if (!state.driving) return;
        if (!state.begun_ms || now_ms - state.begun_ms > state.row.t_s * 1000 + 200) state.begun_ms = now_ms - state.row.t_s * 1000;
        while (state.row.t_s * 1000 < now_ms - state.begun_ms) {
            const goesOn = chip.next();
            take();
            if (!goesOn || state.stood_s > stands_s) return stop();
        }
        draw();
        if (state.frames++ % 6 === 0) drawTrace();
        requestAnimationFrame(step);
    }

    function drawTrace() {
        trace.hidden = state.trace.t.length < 2;
        if (!trace.hidden)
            drawing.innerHTML = traceFigure({ ...tab, images: [state.image], runs: { [`${state.image.id}/yourself`]: { trace: state.trace } } }, "yourself");
    }

    function draw() {
        state.widest_m = state.row.t_s > 0 ? Math.max(state.widest_m, state.row.gap_m ?? 0) : state.row.gap_m ?? 0;
        const width = Math.max(300, scene.clientWidth || 700), { name, short, id } = state.image;
        const run = { name, short, colour: seriesColour(tab, id), at: state.row, trace: { gap_m: [state.widest_m] }, ended: state.ended, impact: state.impact, chosen: true };
        const picture = scenes[tab.scene.name]({ ...tab.scene, fit: 1, width }, [run]);
        scene.setAttribute("viewBox", `0 0 ${width} ${picture.height}`);
        scene.setAttribute("height", picture.height);
        scene.innerHTML = picture.svg;
        chips.forEach((one, k) => one.setAttribute("aria-pressed", images[k] === state.image));
        clock.textContent = `${state.row.t_s.toFixed(2)} s`;
        readout.replaceChildren(...tab.columns.filter((column) => column.shown).map((column) => {
            const value = state.row[column.key];
            return make("div", {}, make("span", {}, column.name),
                make("b", {}, value == null || value === "" ? "–" : typeof value === "number" ? `${value.toFixed(column.digits)} ${column.unit}` : value));
        }));
    }

    let drawn_px = 0;
    new ResizeObserver(() => {
        if (scene.clientWidth === drawn_px) return;
        drawn_px = scene.clientWidth;
        requestAnimationFrame(draw);
    }).observe(element);
    rest();
    return { element, state, start, stop, step, draw, brakes, outcome };
}
