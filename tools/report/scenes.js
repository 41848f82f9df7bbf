// SPDX-License-Identifier: MIT
/* What the player draws: one function a scene, from the state at one moment to SVG text. Nothing is
 * kept between two frames, so the slider may jump as it likes.
 *
 * A scene gets (view, runs): view = {width, metres, scenario}; each run = {name, colour, at, path,
 * ended, impact, chosen}. `at` holds the columns at this moment, interpolated, and x_m, the way
 * driven. It returns {height, svg}. */
"use strict";

const svgText = (x, y, text, more = "") =>
    `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" ${more}>${escapeText(text)}</text>`;

function escapeText(text) {
    return String(text).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
}

/* A car from above, its nose at (x, y), `length` long, seen to the right. */
function carShape(x, y, length, colour, brakePct) {
    const width = length * 0.5, left = x - length, top = y - width / 2, r = length * 0.14;
    const lamp = brakePct > 0 ? `<g fill="#ff2a2a" opacity="${(0.35 + 0.65 * brakePct / 100).toFixed(2)}">` +
        [top + width * 0.06, top + width * 0.72].map((at) =>
            `<rect x="${(left - 3).toFixed(1)}" y="${at.toFixed(1)}" width="5" height="${(width * 0.22).toFixed(1)}" rx="2"/>`).join("") + "</g>" : "";
    return `<g transform="translate(0 0)"><rect x="${left.toFixed(1)}" y="${top.toFixed(1)}" width="${length.toFixed(1)}" height="${width.toFixed(1)}" rx="${r.toFixed(1)}" fill="${colour}" stroke="rgb(0 0 0 / 45%)"/>` +
        `<rect x="${(left + length * 0.56).toFixed(1)}" y="${(top + width * 0.12).toFixed(1)}" width="${(length * 0.16).toFixed(1)}" height="${(width * 0.76).toFixed(1)}" rx="2" fill="rgb(10 20 30 / 60%)"/>` +
        `<rect x="${(left + length * 0.1).toFixed(1)}" y="${(top + width * 0.16).toFixed(1)}" width="${(length * 0.1).toFixed(1)}" height="${(width * 0.68).toFixed(1)}" rx="2" fill="rgb(10 20 30 / 45%)"/></g>` + lamp;
}

function burst(x, y, size) {
    const points = [];
    for (let k = 0; k < 16; k++) {
        const r = k % 2 ? size * 0.45 : size, a = k * Math.PI / 8;
        points.push(`${(x + r * Math.cos(a)).toFixed(1)},${(y + r * Math.sin(a)).toFixed(1)}`);
    }
    return `<polygon points="${points.join(" ")}" fill="#ffb020" stroke="#d0312d" stroke-width="2"/>`;
}

/* The strip above a lane: who drives, in which state, how much brake. */
function strip(view, run, top, state) {
    const brake = run.at.brake_pct || 0, hit = run.ended && run.impact > 0;
    const width = Math.min(150, view.width * 0.3), left = view.width - 10 - width;
    return `<rect x="0" y="${top}" width="${view.width}" height="28" fill="var(--card)"/>` +
        `<rect x="0" y="${top}" width="5" height="28" fill="${run.colour}"/>` +
        svgText(12, top + 19, view.width < 520 ? run.short : run.name, 'fill="var(--ink)" font-size="14" font-weight="600"') +
        svgText(left - 10, top + 19, hit ? `impact at ${run.impact.toFixed(1)} m/s` : state, `fill="${hit ? "var(--bad)" : "var(--soft)"}" font-size="13" text-anchor="end"`) +
        `<rect x="${left}" y="${top + 8}" width="${width}" height="13" rx="3" fill="none" stroke="var(--line)"/>` +
        `<rect x="${left}" y="${top + 8}" width="${(width * Math.min(brake, 100) / 100).toFixed(1)}" height="13" rx="3" fill="${run.at.stop ? "var(--bad)" : run.colour}"/>` +
        svgText(left + width / 2, top + 19, `${run.at.stop ? "STOP " : ""}${brake.toFixed(0)} %`, 'fill="var(--ink)" font-size="12" text-anchor="middle" stroke="var(--card)" stroke-width="2.5" paint-order="stroke"');
}

/* The road's surface with the marks at its lines, moved on by cameraM metres. */
function surface(view, top, height, lines, cameraM, scale) {
    let svg = `<rect x="0" y="${top}" width="${view.width}" height="${height}" fill="var(--road)"/>`;
    const dash = view.dash * scale, shift = ((cameraM % view.dash) + view.dash) % view.dash * scale;
    for (let x = -shift - dash; x < view.width + dash; x += dash)
        for (const y of lines)
            svg += `<rect x="${x.toFixed(1)}" y="${y}" width="${(dash * 0.5).toFixed(1)}" height="2" fill="var(--mark)" opacity="0.75"/>`;
    return svg;
}

/* The distance between two noses, with its number. */
function dimension(fromX, toX, y, text) {
    const from = Math.max(fromX, 20);
    return `<path d="M ${from.toFixed(1)} ${y} H ${toX.toFixed(1)}" stroke="#fff" stroke-width="1.2" opacity="0.85"/>` +
        svgText((from + toX) / 2, y - 6, text, 'fill="#fff" font-size="13" text-anchor="middle"');
}

/* How many metres the picture is wide: as described, or, with "fit", as the widest gap and the own car need. */
function metresOf(view, runs) {
    if (!view.fit) return view.metres;
    return Math.max(view.metres, 1.4 * Math.max(...runs.flatMap((run) => (run.trace.gap_m ?? []).filter((gap) => gap != null)), 0));
}

/* The own car, or an arrow where it is too far behind to be in the picture. */
function ownCar(run, x, y, length) {
    return x > -length * 0.2 ? carShape(x, y, length, run.colour, run.at.brake_pct || 0)
        : `<path d="M 6 ${y} l 12 -9 v 18 z" fill="${run.colour}"/>`;
}

/* A road from above, one lane a run. The camera keeps to the car ahead, which drives alike in all
 * runs, so the lanes can be compared; without one, to the own car. */
function sceneRoad(view, runs) {
    const lane = 104, metres = metresOf(view, runs), scale = view.width / metres;
    const car = Math.max(22, Math.min(view.carM * scale, 0.075 * view.width)), leadX = view.width * 0.82;
    let svg = "";
    runs.forEach((run, k) => {
        const top = k * lane, y = top + 58, at = run.at, gap = at.gap_m, ahead = gap != null;
        const noseX = ahead ? leadX - gap * scale : view.width * 0.35;
        svg += strip(view, run, top, at.state || "") +
            surface({ ...view, dash: view.dash * metres / view.metres }, top + 28, 60, [top + 31, top + 83], ahead ? at.x_m + gap : at.x_m, scale) +
            `<rect x="0" y="${top + 88}" width="${view.width}" height="${lane - 88}" fill="var(--verge)"/>`;
        /* The sensor's beam, and the distance of STOP. */
        if (view.rangeM > 0) {
            const reach = (ahead ? Math.min(view.rangeM, Math.max(gap, 0)) : view.rangeM) * scale, half = 15 * reach / (view.rangeM * scale);
            svg += `<path d="M ${noseX.toFixed(1)} ${y} l ${reach.toFixed(1)} ${(-half).toFixed(1)} q ${(half * 0.4).toFixed(1)} ${half.toFixed(1)} 0 ${(2 * half).toFixed(1)} z" fill="${run.colour}" opacity="0.3"/>`;
        }
        if (view.stopM > 0) {
            const x = (noseX + view.stopM * scale).toFixed(1);
            svg += `<line x1="${x}" x2="${x}" y1="${y - 24}" y2="${y + 24}" stroke="#ff5b4d" stroke-width="2" stroke-dasharray="4 3"/>`;
        }
        if (ahead) svg += carShape(leadX + car, y, car, "#c9ced6", 0);
        svg += ownCar(run, noseX, y, car);
        if (ahead && gap > 0.02 * metres) svg += dimension(noseX, leadX, y, `${gap.toFixed(gap < 20 ? 2 : 1)} m`);
        if (run.impact > 0 && run.ended) svg += burst(leadX, y, 20);
    });
    return { height: runs.length * lane, svg };
}

/* Two lanes a run; the own robot is in the upper one after a change. The one ahead of it is shown in
 * the lane that the own robot is in. */
function sceneLanes(view, runs) {
    const block = 140, metres = metresOf(view, runs), scale = view.width / metres, size = Math.min(40, Math.max(16, 0.5 * scale));
    const ownX = view.width * 0.14;
    let svg = "";
    runs.forEach((run, k) => {
        const top = k * block, at = run.at, gap = at.gap_m, changed = at.lane > 0;
        const y = top + 28 + (changed ? 25 : 75), leadX = ownX + (gap ?? 0) * scale;
        svg += strip(view, run, top, at.state || "") + surface(view, top + 28, 100, [top + 31, top + 77, top + 123], at.x_m, scale) +
            `<rect x="0" y="${top + 128}" width="${view.width}" height="${block - 128}" fill="var(--verge)"/>`;
        const robot = (x, colour) => `<rect x="${(x - size).toFixed(1)}" y="${(y - size / 2).toFixed(1)}" width="${size.toFixed(1)}" height="${size.toFixed(1)}" rx="${(size * 0.3).toFixed(1)}" fill="${colour}" stroke="rgb(0 0 0 / 45%)"/>` +
            `<circle cx="${(x - size * 0.3).toFixed(1)}" cy="${y}" r="${(size * 0.13).toFixed(1)}" fill="rgb(10 20 30 / 60%)"/>`;
        if (gap != null) svg += robot(leadX + size, "#c9ced6") + (gap > 0.04 * metres ? dimension(ownX, leadX, y, `${gap.toFixed(2)} m`) : "");
        svg += robot(ownX, run.colour);
        if (at.asks_lane > 0 && !changed) svg += svgText(ownX - size / 2, y - size / 2 - 5, "▲", 'fill="#ffc44d" font-size="14" text-anchor="middle"');
        if (run.impact > 0 && run.ended) svg += burst(leadX, y, 20);
    });
    return { height: runs.length * block, svg };
}

/* A yard from above: x to the right, y up, the place to park at the origin. The car's path so far is
 * drawn out, the rest of it is faint. */
function sceneYard(view, runs) {
    const length = view.carM, margin = length * 1.6;
    const all = (key) => runs.flatMap((run) => run.trace[key] ?? []);
    const xs = [-margin, margin, ...all("x_m")], ys = [0, ...all("y_m")];
    const left = Math.min(...xs) - margin, right = Math.max(...xs) + margin, low = Math.min(...ys) - margin / 2, high = Math.max(...ys) + margin;
    const height = Math.min(520, view.width * (high - low) / (right - left)), scale = Math.min(view.width / (right - left), height / (high - low));
    const px = (x, y) => `${(view.width / 2 + (x - (left + right) / 2) * scale).toFixed(1)},${(height - (y - low) * scale).toFixed(1)}`;
    const turned = (x, y, angle, along, across) => px(x + along * Math.cos(angle) - across * Math.sin(angle), y + along * Math.sin(angle) + across * Math.cos(angle));
    const box = (x, y, angle, from, to, half, style) =>
        `<polygon points="${[[from, -half], [to, -half], [to, half], [from, half]].map(([along, across]) => turned(x, y, angle, along, across)).join(" ")}" ${style}/>`;
    let svg = `<rect width="${view.width}" height="${height}" fill="var(--road)"/>`;
    /* A line every 5 m, over the whole picture, whatever its shape. */
    const wide = view.width / scale, from = Math.floor((left - wide) / 5) * 5;
    for (let m = from; m <= right + wide; m += 5) svg += `<path d="M ${px(m, low)} L ${px(m, high)}" stroke="var(--mark)" opacity="0.12"/>`;
    for (let m = Math.ceil(low / 5) * 5; m <= high; m += 5) svg += `<path d="M ${px(left - wide, m)} L ${px(right + wide, m)}" stroke="var(--mark)" opacity="0.12"/>`;
    svg += box(0, 0, Math.PI / 2, -0.35 * length, 1.35 * length, 0.42 * length, 'fill="none" stroke="var(--mark)" stroke-width="2" stroke-dasharray="6 4"');
    for (const run of runs) {
        const { x_m: x, y_m: y, heading_deg: heading, steer_deg: steer } = run.at, angle = heading * Math.PI / 180;
        const points = run.trace.x_m.map((value, k) => px(value, run.trace.y_m[k])), until = indexAt(run.trace.t, run.at.t_s) + 1;
        svg += `<polyline points="${points.join(" ")}" fill="none" stroke="#fff" stroke-width="1.5" opacity="0.5" stroke-dasharray="3 4"/>` +
            `<polyline points="${[...points.slice(0, until), px(x, y)].join(" ")}" fill="none" stroke="#fff" stroke-width="4.5" opacity="0.35"/>` +
            `<polyline points="${[...points.slice(0, until), px(x, y)].join(" ")}" fill="none" stroke="${run.colour}" stroke-width="2.5"/>` +
            box(x, y, angle, -0.22 * length, 1.22 * length, 0.24 * length, `fill="${run.colour}" fill-opacity="0.75" stroke="#fff" stroke-width="1.2"`) +
            box(x, y, angle, 0.72 * length, 0.9 * length, 0.2 * length, 'fill="rgb(10 20 30 / 55%)"');
        for (const side of [-0.2, 0.2]) {
            const wheelX = x + length * Math.cos(angle) - side * length * Math.sin(angle), wheelY = y + length * Math.sin(angle) + side * length * Math.cos(angle);
            svg += box(wheelX, wheelY, angle + (steer ?? 0) * Math.PI / 180, -0.09 * length, 0.09 * length, 0.035 * length, 'fill="#111"');
        }
    }
    return { height, svg };
}

const scenes = { road: sceneRoad, lanes: sceneLanes, yard: sceneYard };
