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

/* A road from above, one lane a run. The camera keeps to the car ahead, which drives alike in all
 * runs, so the lanes can be compared; without one, to the own car. */
function sceneRoad(view, runs) {
    const lane = 104, scale = view.width / view.metres, car = Math.min(0.45 * view.carScale, 0.16 * view.metres) * scale;
    const leadX = view.width * 0.82;
    let svg = "";
    runs.forEach((run, k) => {
        const top = k * lane, y = top + 58, at = run.at;
        const gap = at.gap_m, ahead = gap != null;
        const noseX = ahead ? leadX - gap * scale : view.width * 0.35;
        const cameraM = ahead ? at.x_m + gap : at.x_m;
        svg += `<rect x="0" y="${top + 28}" width="${view.width}" height="60" fill="var(--road)"/>`;
        const dash = view.dash * scale, shift = ((cameraM % view.dash) + view.dash) % view.dash * scale;
        for (let x = -shift - dash; x < view.width + dash; x += dash)
            svg += `<rect x="${x.toFixed(1)}" y="${top + 31}" width="${(dash * 0.5).toFixed(1)}" height="2" fill="var(--mark)" opacity="0.75"/>` +
                `<rect x="${x.toFixed(1)}" y="${top + 83}" width="${(dash * 0.5).toFixed(1)}" height="2" fill="var(--mark)" opacity="0.75"/>`;
        /* The sensor's beam, its range, and the stop line. */
        const reach = (ahead ? Math.min(view.rangeM, Math.max(gap, 0)) : view.rangeM) * scale, half = 15 * reach / (view.rangeM * scale);
        svg += `<path d="M ${noseX.toFixed(1)} ${y} l ${reach.toFixed(1)} ${-half} q ${(half * 0.4).toFixed(1)} ${half} 0 ${2 * half} z" fill="${run.colour}" opacity="0.22"/>`;
        if (view.stopM > 0)
            svg += `<line x1="${(noseX + view.stopM * scale).toFixed(1)}" x2="${(noseX + view.stopM * scale).toFixed(1)}" y1="${y - 24}" y2="${y + 24}" stroke="#ff5b4d" stroke-width="2" stroke-dasharray="4 3"/>`;
        if (ahead)
            svg += carShape(leadX + car, y, car, "#c9ced6", at.lead_brakes ? 60 : 0);
        if (noseX > -car * 0.2)
            svg += carShape(noseX, y, car, run.colour, at.brake_pct || 0);
        else
            svg += `<path d="M 6 ${y} l 12 -9 v 18 z" fill="${run.colour}"/>`;
        if (ahead && gap > 0.02 * view.metres) {
            const from = Math.max(noseX, 20), middle = (from + leadX) / 2;
            svg += `<path d="M ${from.toFixed(1)} ${y} H ${leadX.toFixed(1)}" stroke="#fff" stroke-width="1.2" opacity="0.85"/>` +
                svgText(middle, y - 6, `${gap.toFixed(2)} m`, 'fill="#fff" font-size="13" text-anchor="middle"');
        }
        if (run.impact > 0 && run.ended)
            svg += burst(leadX, y, 20);
        /* What the controller does, above the lane. */
        const brake = at.brake_pct || 0, state = run.ended && run.impact > 0 ? `impact at ${run.impact.toFixed(1)} m/s` : at.state || "";
        const gaugeX = view.width - 10 - Math.min(150, view.width * 0.3), gaugeW = view.width - 10 - gaugeX;
        svg += `<rect x="0" y="${top}" width="${view.width}" height="28" fill="var(--card)"/>` +
            `<rect x="0" y="${top + 88}" width="${view.width}" height="${lane - 88}" fill="var(--verge)"/>` +
            `<rect x="0" y="${top}" width="5" height="28" fill="${run.colour}"/>` +
            svgText(12, top + 19, view.width < 520 ? run.short : run.name, 'fill="var(--ink)" font-size="14" font-weight="600"') +
            svgText(gaugeX - 10, top + 19, state, `fill="${run.ended && run.impact > 0 ? "var(--bad)" : "var(--soft)"}" font-size="13" text-anchor="end"`) +
            `<rect x="${gaugeX}" y="${top + 8}" width="${gaugeW}" height="13" rx="3" fill="none" stroke="var(--line)"/>` +
            `<rect x="${gaugeX}" y="${top + 8}" width="${(gaugeW * Math.min(brake, 100) / 100).toFixed(1)}" height="13" rx="3" fill="${at.stop ? "var(--bad)" : run.colour}"/>` +
            svgText(gaugeX + gaugeW / 2, top + 19, `${at.stop ? "STOP " : ""}${brake.toFixed(0)} %`, 'fill="var(--ink)" font-size="12" text-anchor="middle" stroke="var(--card)" stroke-width="2.5" paint-order="stroke"');
    });
    return { height: runs.length * lane, svg };
}

const scenes = { road: sceneRoad };
