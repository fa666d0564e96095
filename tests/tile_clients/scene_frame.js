// SPDX-License-Identifier: MIT
// The view of a page, from its address: tileset, the place of the scene on the Earth, camera and target in coordinates
// of the scene (+X east, +Y up, -Z north), tolerated error in pixels.
export function readView() {
    const query = new URLSearchParams(location.search);
    const numbers = name => query.get(name).split(',').map(Number);
    return {
        tileset: query.get('tileset'),
        origin: numbers('origin'), // longitude, latitude in degrees; height in m
        eye: numbers('eye'),
        at: numbers('at'),
        error: Number(query.get('error')),
    };
}

// Coordinates east, north, up of a place of the scene.
export function eastNorthUp([x, y, z]) {
    return [x, -z, y];
}
