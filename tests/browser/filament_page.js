// Draws a cube map of Filament's cmgen as the sky of Filament, one direction after the other. Runs in the page of
// filament.js.

const intensity_of_skies = 30000;  // cd/m^2 for a texel of 1, where no indirect light says otherwise

// The colours, three bytes each, in the middle of a small picture that looks in each direction. A radiance of 1 is
// drawn as `scale`.
window.look = async (url, directions, scale) => {
    await new Promise((resolve) => Filament.init([url], resolve));
    const canvas = document.getElementById('canvas');
    const engine = Filament.Engine.create(canvas, {preserveDrawingBuffer: true});
    const scene = engine.createScene();
    const texture = engine.createTextureFromKtx1(url, {rgbm: false});
    const sky = Filament.Skybox.Builder().environment(texture).build(engine);
    scene.setSkybox(sky);
    const swap = engine.createSwapChain();
    const renderer = engine.createRenderer();
    const camera = engine.createCamera(Filament.EntityManager.get().create());
    camera.setProjectionFov(2, canvas.width / canvas.height, 0.1, 10, Filament.Camera$Fov.VERTICAL);
    // A shutter of t s at f/1 and ISO 100 exposes by t / 1.2.
    camera.setExposure(1, 1.2 * scale / intensity_of_skies, 100);
    const view = engine.createView();
    view.setCamera(camera);
    view.setScene(scene);
    view.setViewport([0, 0, canvas.width, canvas.height]);
    view.setPostProcessingEnabled(false);
    const gl = canvas.getContext('webgl2');
    const colors = [];
    for (const direction of directions) {
        camera.lookAt([0, 0, 0], direction, Math.abs(direction[1]) > 0.99 ? [1, 0, 0] : [0, 1, 0]);
        for (let frame = 0; frame < 3; ++frame) {
            await new Promise(requestAnimationFrame);
            renderer.render(swap, view);
        }
        const pixel = new Uint8Array(4);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.readPixels(canvas.width / 2, canvas.height / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        colors.push(Array.from(pixel.slice(0, 3)));
    }
    return colors;
};
