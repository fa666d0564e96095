// SPDX-License-Identifier: MIT
// Shows a tileset in CesiumJS, without a globe and without services of Cesium. Sets window.isSettled when the view is
// complete.
import { eastNorthUp, readView } from './scene_frame.js';

const { Cesium } = window;
const view = readView();
const viewer = new Cesium.Viewer('view', {
    globe: false,
    baseLayer: false,
    baseLayerPicker: false,
    geocoder: false,
    animation: false,
    timeline: false,
    fullscreenButton: false,
    homeButton: false,
    sceneModePicker: false,
    navigationHelpButton: false,
    infoBox: false,
    selectionIndicator: false,
    skyBox: false,
    contextOptions: { webgl: { preserveDrawingBuffer: true } },
});
viewer.scene.backgroundColor = Cesium.Color.fromCssColorString('#a9c3d6');
viewer.scene.light = new Cesium.DirectionalLight({
    direction: Cesium.Cartesian3.normalize(
        Cesium.Matrix4.multiplyByPointAsVector(
            Cesium.Transforms.eastNorthUpToFixedFrame(Cesium.Cartesian3.fromDegrees(...view.origin)),
            new Cesium.Cartesian3(-0.4, -0.5, -0.8),
            new Cesium.Cartesian3(),
        ),
        new Cesium.Cartesian3(),
    ),
    intensity: 2.0,
});

if (view.tileset === '') {
    window.isSettled = true; // an empty page, to compare times with
} else {
    const tileset = await Cesium.Cesium3DTileset.fromUrl(view.tileset, { maximumScreenSpaceError: view.error });
    viewer.scene.primitives.add(tileset);
    window.failures = [];
    tileset.tileFailed.addEventListener(failure => window.failures.push(`${failure.url}: ${failure.message}`));
    const frame = Cesium.Transforms.eastNorthUpToFixedFrame(Cesium.Cartesian3.fromDegrees(...view.origin));
    const place = point =>
        Cesium.Matrix4.multiplyByPoint(frame, new Cesium.Cartesian3(...eastNorthUp(point)), new Cesium.Cartesian3());
    const eye = place(view.eye);
    const direction = Cesium.Cartesian3.subtract(place(view.at), eye, new Cesium.Cartesian3());
    Cesium.Cartesian3.normalize(direction, direction);
    const up = Cesium.Matrix4.multiplyByPointAsVector(frame, new Cesium.Cartesian3(0, 0, 1), new Cesium.Cartesian3());
    viewer.camera.setView({ destination: eye, orientation: { direction, up } });
    let stillFrames = 0;
    viewer.scene.postRender.addEventListener(() => {
        stillFrames = tileset.tilesLoaded ? stillFrames + 1 : 0;
        window.isSettled = stillFrames > 10;
        window.tileCounts = { visible: tileset.statistics?.selected, triangles: tileset.statistics?.numberOfTrianglesSelected };
    });
}
