// SPDX-License-Identifier: MIT
/* The figures, as SVG text in the page's own colours, so that they follow the light or dark setting.
 * A function of `figures` draws one figure: (tab, settings, images, rows). `settings` is the tab's
 * description of the figure, `images` are the controllers to draw, `rows` is the figure's data file. */
"use strict";

const xml = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;");
const px = (value) => Number(value.toFixed(1));

/* A drawing area of an SVG: from values of both axes to pixels. */
function plotArea(box, xRange, yRange) {
    const scale = (value, [from, to], low, high) => low + (value - from) / (to - from || 1) * (high - low);
    return { ...box, x: (value) => px(scale(value, xRange, box.left, box.right)), y: (value) => px(scale(value, yRange, box.bottom, box.top)) };
}
function svg(width, height, ...parts) {
    return `<svg viewBox="0 0 ${width} ${height}" xmlns="http://www.w3.org/2000/svg">${parts.flat(9).join("")}</svg>`;
}
const line = (points, style) => `<polyline points="${points.map((point) => point.join(",")).join(" ")}" fill="none" ${style}/>`;
const label = (x, y, text, anchor, size, colour = "soft", more = "") =>
    `<text x="${px(x)}" y="${px(y)}" text-anchor="${anchor}" font-size="${size}" fill="var(--${colour})" ${more}>${xml(text)}</text>`;

/* Some four round numbers from low to high. */
function tics(low, high) {
    const raw = (high - low) / 4 || 1, power = 10 ** Math.floor(Math.log10(raw) + 1e-9), part = raw / power;
    const step = power * (part <= 1.01 ? 1 : part <= 2.01 ? 2 : part <= 5.01 ? 5 : 10), list = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k++) list.push(Number((k * step).toPrecision(6)));
    return { list, step };
}
/* The frame of a plot: left and bottom line, tics with numbers, grid. */
function axes(area, xTics, yTics, size, xNumbers = true) {
    return [
        xTics.map((value) => `<path d="M${area.x(value)},${area.top}V${area.bottom}" stroke="var(--grid)" stroke-width="0.7"/>`),
        yTics.map((value) => `<path d="M${area.left},${area.y(value)}H${area.right}" stroke="var(--grid)" stroke-width="0.7"/>`),
        `<path d="M${area.left},${area.top}V${area.bottom}H${area.right}" stroke="var(--soft)" fill="none"/>`,
        xNumbers ? xTics.map((value) => label(area.x(value), area.bottom + size + 3, value, "middle", size)) : "",
        yTics.map((value) => label(area.left - 6, area.y(value) + size / 3, value, "end", size)),
    ];
}
const besideY = (area, text, size) => label(size, (area.top + area.bottom) / 2, text, "middle", size, "soft", `transform="rotate(-90 ${size} ${px((area.top + area.bottom) / 2)})"`);

/* --- one scenario over time --------------------------------------------------------------------- */

/* The part of the width between the left and the right margin; the player lays its cursor over it. */
const traceMargins = { left: 0.11, right: 0.97 };

function traceFigure(tab, scenario) {
    const runs = tab.images.map((image) => ({ colour: seriesColour(tab, image.id), trace: runOf(tab, image.id, scenario)?.trace })).filter((run) => run.trace);
    if (!runs.length) return "";
    const width = 480, each = 122, height = each * tab.panels.length + 40;
    const end_s = Math.max(...runs.map((run) => run.trace.t.at(-1)));
    const curve = (area, run, key, style) => {
        const values = run.trace[key] ?? [], pieces = [[]];
        values.forEach((value, k) => (value == null ? pieces.push([]) : pieces.at(-1).push([area.x(run.trace.t[k]), area.y(value)])));
        return pieces.filter((piece) => piece.length > 1).map((piece) => line(piece, style));
    };
    return svg(width, height, tab.panels.map((panel, p) => {
        const keys = [panel.column, panel.reference].filter((key) => key);
        const values = runs.flatMap((run) => keys.flatMap((key) => run.trace[key] ?? [])).filter((value) => value != null);
        const { step } = tics(panel.low ?? Math.min(...values, 0), panel.high ?? Math.max(...values, 0));
        const low = panel.low ?? Math.floor(Math.min(...values) / step) * step, high = panel.high ?? Math.ceil(Math.max(...values) / step) * step;
        const area = plotArea({ left: traceMargins.left * width, right: traceMargins.right * width, top: each * p + 20, bottom: each * (p + 1) - 4 },
            [0, end_s], [low, high > low ? high : low + 1]);
        return [axes(area, tics(0, end_s).list, tics(low, high > low ? high : low + 1).list, 12, p === tab.panels.length - 1),
            label(area.left, area.top - 6, panel.label, "start", 14, "ink"),
            panel.reference ? curve(area, runs[0], panel.reference, 'stroke="var(--soft)" stroke-width="1.5" stroke-dasharray="5 4"') : "",
            runs.map((run) => curve(area, run, panel.column, `stroke="${run.colour}" stroke-width="1.8"`))];
    }), label(0.54 * width, height - 6, "time, s", "middle", 12));
}

/* --- maps of cells --------------------------------------------------------------------------------- */

/* cells: {column, row, level, text}; a level is one of the page's colours --m0 to --m4, or null. */
function cellMap(width, height, columns, rows, cells, xLabel, yLabel, more = () => "") {
    const area = plotArea({ left: 0.13 * width, right: 0.98 * width, top: 0.02 * height, bottom: height - 52 },
        [0.5, columns.length + 0.5], [0.5, rows.length + 0.5]);
    const some = (list, room) => Math.ceil(list.length * 26 / room);
    const everyX = some(columns, area.right - area.left), everyY = some(rows, area.bottom - area.top);
    return svg(width, height,
        cells.map(({ column, row, level, text }) => [
            level == null ? "" : `<rect x="${area.x(column - 0.48)}" y="${area.y(row + 0.47)}" width="${px(area.x(column + 0.48) - area.x(column - 0.48))}" height="${px(area.y(row - 0.47) - area.y(row + 0.47))}" fill="var(--m${level})"/>`,
            text === "" ? "" : label(area.x(column), area.y(row) + 4, text, "middle", 11, "ink")]),
        more(area),
        columns.map((value, k) => (k % everyX ? "" : label(area.x(k + 1), area.bottom + 16, value, "middle", 12))),
        rows.map((value, k) => (k % everyY ? "" : label(area.left - 6, area.y(k + 1) + 4, value, "end", 12))),
        label((area.left + area.right) / 2, height - 12, xLabel, "middle", 13), besideY(area, yLabel, 13));
}
const sorted = (values) => [...new Set(values)].sort((a, b) => a - b);

/* The avoidance map: the scenarios of a group, named PREFIX_vSPEED_bDECELERATION. */
function avoidanceMap(tab, settings, [image]) {
    const runs = (tab.groups.find((group) => group.id === settings.group)?.scenarios ?? []).map((name) => {
        const [, speed, decel] = name.split("_");
        return { name, run: runOf(tab, image.id, name), speed: Number(speed.slice(1)), decel: Number(decel.slice(1)), owed_mps: tab.scenarios[name].owed_mps };
    }).filter((one) => one.run);
    const speeds = sorted(runs.map((one) => one.speed)), decels = sorted(runs.map((one) => one.decel));
    const cells = runs.map(({ run, speed, decel }) => {
        const impact = run.values?.impact_mps ?? 0, place = { column: decels.indexOf(decel) + 1, row: speeds.indexOf(speed) + 1 };
        if (!run.ok) return { ...place, level: null, text: "?" };
        return { ...place, level: [0, 1, 3, 6].filter((limit) => impact > limit).length, text: impact > 0 ? impact.toFixed(1) : "" };
    });
    /* Below this line no impact is owed. */
    const border = (area) => line(decels.flatMap((decel, k) => {
        const owed = (speed) => runs.find((one) => one.speed === speed && one.decel === decel)?.owed_mps === 0;
        const below = speeds.findIndex((speed) => !owed(speed)), row = (below < 0 ? speeds.length : below) + 0.5;
        return [[area.x(k + 0.5), area.y(row)], [area.x(k + 1.5), area.y(row)]];
    }), 'stroke="var(--ink)" stroke-width="2.2" stroke-dasharray="9 6"');
    return cellMap(400, 400, decels, speeds, cells, "the car ahead brakes, m/s²", "both at, m/s", border);
}

/* A map of starts from a CSV. Starts that differ in other columns than the axes share a cell: it shows
 * how many of them have the value 1, or, with `share`, what share of them. */
function startMap(tab, settings, images, rows) {
    const xs = sorted(rows.x), ys = sorted(rows.y), cells = new Map();
    rows.value.forEach((value, k) => {
        const column = xs.indexOf(rows.x[k]) + 1, row = ys.indexOf(rows.y[k]) + 1, key = `${column} ${row}`;
        const cell = cells.get(key) ?? { column, row, sum: 0, count: 0 };
        cell.sum += value;
        cell.count++;
        cells.set(key, cell);
    });
    const share = settings.show === "share";
    const drawn = [...cells.values()].map(({ column, row, sum, count }) => ({ column, row,
        level: share ? [1, 0.75, 0.5, 0.25].filter((limit) => sum / count < limit).length : Math.min(sum, 4),
        text: share || !sum ? "" : sum }));
    return cellMap(400, 360, xs, ys, drawn, settings.xLabel, settings.yLabel);
}

/* A map of the chip: of each byte the worst outcome of a flip of its bits, as tests/flips/flips.sh numbers them.
 * A line of the map is 16 bytes; registers stand 16 lines behind RAM. */
function flipMap(tab, settings, images, rows) {
    const digit = (value) => value.toString(16).toUpperCase(), outcomes = [["", 0], ["c", 1], ["s", 1], ["F", 2], ["W", 3], ["U", 4]];
    const lines = sorted(rows.y).reverse(), columns = sorted(rows.x);
    const cells = rows.value.map((value, k) => ({ column: columns.indexOf(rows.x[k]) + 1, row: lines.indexOf(rows.y[k]) + 1,
        level: outcomes[value][1], text: outcomes[value][0] }));
    return cellMap(520, 560, columns.map(digit), lines.map((line) => (line < 16 ? `${digit(line)}0` : `SFR ${digit(line - 16)}0`)), cells, settings.xLabel, settings.yLabel);
}

/* A table of rules: what it commands over two inputs; a cell names each answer that it gives over the
 * third. The value is -1 to 1, `also` is 1 where it asks for the next lane. */
function ruleMap(tab, settings, images, rows) {
    const xs = sorted(rows.x), ys = sorted(rows.y), words = ["slow down", "hold", "speed up"];
    const cells = xs.flatMap((x, i) => ys.map((y, j) => {
        const here = rows.value.map((_, k) => k).filter((k) => rows.x[k] === x && rows.y[k] === y);
        const answers = [...new Set(here.map((k) => words[rows.value[k] + 1] + (rows.also[k] > 0 ? ", lane" : "")))];
        return { column: i + 1, row: j + 1, level: 2 - Math.min(...here.map((k) => rows.value[k])) * 2, answers };
    }));
    const texts = (area) => cells.map(({ column, row, answers }) =>
        answers.map((text, k) => label(area.x(column), area.y(row) + 4 + 15 * (k - (answers.length - 1) / 2), text, "middle", 11, "ink")));
    return cellMap(400, 250, xs, ys.map((y) => Number(y.toFixed(2))), cells.map((cell) => ({ ...cell, text: "" })), settings.xLabel, settings.yLabel, texts);
}

/* The same table as a state diagram: its answers, and which inputs lead from one to another. settings.inputs
 * names each input and its thresholds: "gap, 2 m, 4 m; closing speed, 1 m/s". The third input is in the order
 * of the rows. */
function answerDiagram(tab, settings, images, rows) {
    const inputs = settings.inputs.split(";").map((text) => text.split(",").map((word) => word.trim()));
    const xs = sorted(rows.x), ys = sorted(rows.y), depth = rows.value.length / xs.length / ys.length;
    const words = ["slow down", "hold", "speed up"], seen = new Map(), cells = new Map(), edges = new Map();
    rows.value.forEach((value, k) => {
        const place = `${xs.indexOf(rows.x[k])} ${ys.indexOf(rows.y[k])}`, asks = rows.also[k] > 0;
        const third = seen.get(place) ?? 0;
        seen.set(place, third + 1);
        cells.set(`${place} ${third}`, { name: words[value + 1] + (asks ? ", lane" : ""), x: asks ? 390 : 75, y: 130 - 95 * value });
    });
    const nodes = new Map([...cells.values()].map((cell) => [cell.name, cell]));
    for (const [key, cell] of cells)
        inputs.forEach(([input, ...thresholds], axis) => {
            const index = key.split(" ").map(Number), at = index[axis]++, next = cells.get(index.join(" "));
            if (!next || next.name === cell.name) return;
            const pair = [cell.name, next.name].sort().join("|"), edge = edges.get(pair) ?? new Map();
            edge.set(input, (edge.get(input) ?? new Set()).add(thresholds[at]));
            edges.set(pair, edge);
        });
    if (depth !== (inputs[2]?.length ?? 1)) throw new Error(`${settings.title}: ${depth} cells of the third input`);
    return svg(470, 260,
        [...edges].map(([pair, edge]) => {
            const [from, to] = pair.split("|").map((name) => nodes.get(name)), upright = from.x === to.x, level = from.y === to.y;
            const texts = [...edge].map(([input, thresholds]) => `${input} ${[...thresholds].join(", ")}`);
            const x = (from.x + to.x) / 2 + (upright ? 6 : level ? 0 : 112), y = (from.y + to.y) / 2 + (level ? -7 - 13 * (texts.length - 1) : upright ? 4 - 6.5 * (texts.length - 1) : 26);
            return [line([[from.x, from.y], [to.x, to.y]], 'stroke="var(--soft)" stroke-width="1.5"'),
                texts.map((text, k) => label(x, y + 13 * k, text, upright ? "start" : "middle", 11))];
        }),
        [...nodes.values()].map(({ name, x, y }) => [
            `<rect x="${x - 55}" y="${y - 16}" width="110" height="32" rx="14" fill="var(--m${name.startsWith("slow") ? 4 : name.startsWith("hold") ? 2 : 0})"/>`,
            label(x, y + 4, name, "middle", 12, "ink")]));
}

/* --- other figures ------------------------------------------------------------------------------- */

/* Impact speed over closing speed; the scenarios of a group, named PREFIX_SPEED. */
function impactOverSpeed(tab, settings, images) {
    const names = tab.groups.find((group) => group.id === settings.group)?.scenarios ?? [];
    const points = (of) => names.map((name) => [Number(name.split("_")[1]), of(name)]).filter(([, value]) => value != null);
    const curves = images.map((image) => ({ colour: seriesColour(tab, image.id), name: image.short, width: 2.2, dashes: "",
        points: points((name) => (runOf(tab, image.id, name)?.ok ? runOf(tab, image.id, name).values.impact_mps ?? 0 : null)) }));
    curves.push({ colour: "var(--ink)", name: "owed", width: 1.5, dashes: "6 4", points: points((name) => tab.scenarios[name].owed_mps) });
    const speeds = curves.flatMap((curve) => curve.points.map(([speed]) => speed)), yEnd = 8;
    const area = plotArea({ left: 47, right: 510, top: 10, bottom: 274 }, [Math.min(...speeds), Math.max(...speeds)], [0, yEnd]);
    const inside = ([, value]) => value <= yEnd;
    return svg(520, 330, axes(area, tics(Math.min(...speeds), Math.max(...speeds)).list, tics(0, yEnd).list, 12),
        curves.map((curve, k) => [line(curve.points.filter(inside).map(([speed, value]) => [area.x(speed), area.y(value)]), `stroke="${curve.colour}" stroke-width="${curve.width}" stroke-dasharray="${curve.dashes}"`),
            line([[area.left + 12, area.top + 12 + 18 * k], [area.left + 36, area.top + 12 + 18 * k]], `stroke="${curve.colour}" stroke-width="${curve.width}" stroke-dasharray="${curve.dashes}"`),
            label(area.left + 42, area.top + 16 + 18 * k, curve.name, "start", 13, "ink")]),
        label((area.left + area.right) / 2, 322, "closing speed, m/s", "middle", 13), besideY(area, "impact speed, m/s", 13));
}

/* A table of two inputs as a surface in space: the value over x and y, seen from the corner where x is
 * largest and y is smallest. */
function tableSurface(tab, settings, images, rows) {
    const width = 560, height = 400, turn = 38 * Math.PI / 180, tilt = 62 * Math.PI / 180;
    const xs = sorted(rows.x), ys = sorted(rows.y);
    /* The axes end at round numbers. */
    const ends = (values) => { const { step } = tics(values[0], values.at(-1)); return [Math.floor(values[0] / step) * step, Math.ceil(values.at(-1) / step) * step]; };
    const box = { x: ends(xs), y: ends(ys), z: ends([Math.min(0, ...rows.value), Math.max(...rows.value)]) }, [z0, z1] = box.z;
    const height01 = (z) => (z - z0) / (z1 - z0);
    const value = new Map(rows.value.map((one, k) => [`${rows.x[k]} ${rows.y[k]}`, one]));
    const place = (x, y, z) => {
        const a = 0.5 - (x - box.x[0]) / (box.x[1] - box.x[0]), b = 0.5 - (y - box.y[0]) / (box.y[1] - box.y[0]);
        const across = a * Math.cos(turn) + b * Math.sin(turn), near = -a * Math.sin(turn) + b * Math.cos(turn);
        return { near, at: [px(width / 2 + across * 310), px(height * 0.67 + near * 310 * Math.cos(tilt) - height01(z) * 190 * Math.sin(tilt))] };
    };
    const stops = [[0, [44, 127, 184]], [0.45, [127, 205, 187]], [0.75, [254, 196, 79]], [1, [215, 48, 31]]];
    const colour = (part) => {
        const k = Math.max(1, stops.findIndex(([end]) => part <= end)), [from, low] = stops[k - 1], [to, high] = stops[k];
        return `rgb(${low.map((one, c) => Math.round(one + (high[c] - one) * (part - from) / (to - from))).join(" ")})`;
    };
    const faces = [];
    for (let i = 0; i + 1 < xs.length; i++)
        for (let j = 0; j + 1 < ys.length; j++) {
            const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([a, b]) => ({ x: xs[a], y: ys[b], z: value.get(`${xs[a]} ${ys[b]}`) }));
            const points = corners.map(({ x, y, z }) => place(x, y, z)), mean = corners.reduce((sum, one) => sum + one.z, 0) / 4;
            faces.push({ near: points.reduce((sum, one) => sum + one.near, 0),
                text: `<polygon points="${points.map((one) => one.at.join(",")).join(" ")}" fill="${colour(height01(mean))}" stroke="#555" stroke-width="0.3"/>` });
        }
    faces.sort((a, b) => a.near - b.near);
    const edge = (...points) => line(points.map((point) => place(...point).at), 'stroke="var(--soft)" stroke-width="1"');
    const [x0, x1] = box.x, [y0, y1] = box.y;
    const beside = (x, y, z, text, dx, dy, size = 11, colourName = "soft") => {
        const [at, down] = place(x, y, z).at;
        return label(at + dx, down + dy, text, "middle", size, colourName);
    };
    return svg(width, height,
        edge([x0, y0, z0], [x1, y0, z0], [x1, y1, z0], [x0, y1, z0], [x0, y0, z0]), edge([x1, y1, z0], [x1, y1, z1]),
        edge([x0, y0, z0], [x0, y0, z1]), edge([x0, y1, z0], [x0, y1, z1]), edge([x1, y1, z1], [x0, y1, z1], [x0, y0, z1]),
        faces.map((face) => face.text),
        tics(x0, x1).list.map((x) => beside(x, y0, z0, x, 10, 16)), beside((x0 + x1) / 2, y0, z0, settings.xLabel, 60, 34, 13),
        tics(y0, y1).list.map((y) => beside(x1, y, z0, y, -8, 16)), beside(x1, (y0 + y1) / 2, z0, settings.yLabel, -60, 34, 13),
        tics(z0, z1).list.map((z) => beside(x1, y1, z, z, -16, 4)), beside(x1, y1, z1, settings.show, 6, -12, 13));
}

/* By the name that a tab's description gives. */
const figures = { map: avoidanceMap, starts: startMap, rules: ruleMap, diagram: answerDiagram, limit: impactOverSpeed, flips: flipMap, surface: tableSurface };
