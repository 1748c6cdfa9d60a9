// Draws a sky and lights planes in PlayCanvas by the module of the target. Runs in the page of playcanvas.js.
import * as pc from '/playcanvas/playcanvas.mjs';

async function application() {
    const options = new pc.AppOptions();
    options.graphicsDevice = await pc.createGraphicsDevice(document.createElement('canvas'), {deviceTypes: ['webgl2']});
    options.componentSystems = [pc.CameraComponentSystem, pc.LightComponentSystem, pc.RenderComponentSystem];
    options.resourceHandlers = [pc.TextureHandler];
    const app = new pc.AppBase(document.createElement('canvas'));
    app.init(options);
    return app;
}

// A camera of one pixel, in float and without tone mapping, and what it sees.
function camera_of(app) {
    const picture = new pc.Texture(app.graphicsDevice, {width: 1, height: 1, format: pc.PIXELFORMAT_RGBA32F, mipmaps: false});
    const renderTarget = new pc.RenderTarget({colorBuffer: picture});
    const camera = new pc.Entity();
    camera.addComponent('camera', {renderTarget, fov: 0.01, toneMapping: pc.TONEMAP_NONE, gammaCorrection: pc.GAMMA_NONE});
    app.root.addChild(camera);
    const seen = async () => {
        app.render();
        return Array.from(await picture.read(0, 0, 1, 1, {renderTarget, immediate: true}));
    };
    return {camera, seen};
}

// The values of the skybox in the middle of each view.
window.look = async (url, views) => {
    const app = await application();
    app.scene.skybox = await (await import(url)).load(pc, app);
    const {camera, seen} = camera_of(app);
    const values = [];
    for (const view of views) {
        camera.lookAt(new pc.Vec3(...view));
        values.push(await seen());
    }
    return values;
};

// The three values, for each normal, of a white matt plane with that normal under the sun of the module.
window.light = async (url, normals) => {
    const app = await application();
    app.scene.ambientLight = new pc.Color(0, 0, 0);
    app.root.addChild((await import(url)).sunlight(pc));
    const material = new pc.StandardMaterial();
    Object.assign(material, {diffuse: new pc.Color(1, 1, 1), specular: new pc.Color(0, 0, 0), gloss: 0});
    material.update();
    const plane = new pc.Entity();
    plane.addComponent('render', {type: 'plane', material});
    app.root.addChild(plane);
    const {camera, seen} = camera_of(app);
    const values = [];
    for (const normal of normals.map((axes) => new pc.Vec3(...axes))) {
        plane.setRotation(new pc.Quat().setFromDirections(pc.Vec3.UP, normal));
        camera.setPosition(normal.clone().mulScalar(3));
        camera.lookAt(pc.Vec3.ZERO, Math.abs(normal.y) > 0.9 ? pc.Vec3.RIGHT : pc.Vec3.UP);
        values.push((await seen()).slice(0, 3));
    }
    return values;
};
