'use strict';
// Draws views of a bake by the modules of examples/runtimes/npm, for runtime_example.js. A view is in the recipe's
// axes: x and y along the ground, z up.

const radians = Math.PI / 180;
const direction = (elevation, azimuth) => [Math.cos(elevation * radians) * Math.cos(azimuth * radians),
    Math.cos(elevation * radians) * Math.sin(azimuth * radians), Math.sin(elevation * radians)];
const vertical_field = ({fov, size: [width, height]}) => 2 * Math.atan(Math.tan(0.5 * fov * radians) * height / width);

const canvas_of = ([width, height]) => Object.assign(document.createElement('canvas'), {width, height});

async function three_scene(folder, view) {
    const THREE = await import('three');
    const {Skybake} = await import('skybake/three');
    const sky = await Skybake.load(folder);
    const [x, y, z] = view.position, [ahead_x, ahead_y, ahead_z] = direction(view.pitch, view.heading);
    const renderer = new THREE.WebGLRenderer({canvas: canvas_of(view.size), antialias: false, preserveDrawingBuffer: true});
    renderer.setSize(...view.size, false);
    const camera = new THREE.PerspectiveCamera(vertical_field(view) / radians, view.size[0] / view.size[1], 1, 1e6);
    camera.position.set(x, z, -y);
    camera.lookAt(x + ahead_x, z + ahead_z, -y - ahead_y);
    sky.set_sun(view.sun_elevation, view.sun_azimuth);
    sky.uniforms.skybake_exposure.value = view.exposure;
    sky.update(camera, renderer);
    return {THREE, sky, renderer, camera, scene: new THREE.Scene()};
}

async function babylon_scene(folder, view) {
    const {Skybake} = await import('skybake/babylon');
    const canvas = canvas_of(view.size);
    const engine = new BABYLON.Engine(canvas, false, {preserveDrawingBuffer: true, useExactSrgbConversions: true});
    const scene = new BABYLON.Scene(engine);
    const [x, y, z] = view.position, [ahead_x, ahead_y, ahead_z] = direction(view.pitch, view.heading);
    const camera = new BABYLON.FreeCamera('camera', new BABYLON.Vector3(x, z, y), scene);
    camera.setTarget(new BABYLON.Vector3(x + ahead_x, z + ahead_z, y + ahead_y));
    Object.assign(camera, {fov: vertical_field(view), minZ: 1, maxZ: 1e6});
    const sky = await Skybake.load(folder, scene);
    sky.set_sun(view.sun_elevation, view.sun_azimuth);
    sky.exposure = view.exposure;
    return {sky, scene, canvas, camera};
}

window.draw_by_module = {
    async three(folder, view) {
        const {sky, renderer, camera, scene} = await three_scene(folder, view);
        scene.add(sky.background());
        renderer.render(scene, camera);
        return renderer.domElement;
    },

    async babylon(folder, view) {
        const {sky, scene, canvas} = await babylon_scene(folder, view);
        sky.background();
        await scene.whenReadyAsync();
        scene.render();
        return canvas;
    },
};

const middle_of = (canvas, [width, height]) => {
    const context = canvas_of([width, height]).getContext('2d');
    context.drawImage(canvas, 0, 0);
    return [...context.getImageData(width / 2, height / 2, 1, 1).data].slice(0, 3);
};

// The middle pixel of a wall that stands across the view, so many metres away, behind the air of a module, and that of
// the sky: linear light as sRGB.
window.wall_behind_air = {
    async three(folder, view, distance) {
        const {THREE, sky, renderer, camera, scene} = await three_scene(folder, view);
        const wall = new THREE.Mesh(new THREE.PlaneGeometry(4 * distance, 4 * distance),
            sky.add_air(new THREE.MeshBasicMaterial({color: view.wall, side: THREE.DoubleSide})));
        wall.quaternion.copy(camera.quaternion);
        wall.position.copy(camera.position).addScaledVector(camera.getWorldDirection(new THREE.Vector3()), distance);
        scene.add(wall);
        renderer.render(scene, camera);
        const before_wall = middle_of(renderer.domElement, view.size);
        // The same by a shader of one's own, which has the module's functions.
        const own = sky.background();
        own.material.fragmentShader = `in vec3 ray;\nout vec4 color;\n${sky.glsl}
            void main() { color = vec4(srgb_of(skybake_exposure * linear_srgb(sky(normalize(ray)))), 1.0); }`;
        scene.remove(wall);
        scene.add(own);
        renderer.render(scene, camera);
        return {before_wall, sky: middle_of(renderer.domElement, view.size)};
    },

    // By a material that counts in sRGB and by one that counts in linear light.
    async babylon(folder, view, distance) {
        const {sky, scene, canvas, camera} = await babylon_scene(folder, view);
        const wall = BABYLON.MeshBuilder.CreatePlane('wall', {size: 4 * distance, sideOrientation: BABYLON.Mesh.DOUBLESIDE}, scene);
        wall.position = camera.position.add(camera.getForwardRay(1).direction.scale(distance));
        wall.lookAt(camera.position);
        const colour = BABYLON.Color3.FromHexString(`#${view.wall.toString(16).padStart(6, '0')}`);
        const seen = {};
        for (const Material of [BABYLON.StandardMaterial, BABYLON.PBRMaterial]) {
            wall.material = sky.add_air(new Material('wall', scene));
            Object.assign(wall.material, Material === BABYLON.PBRMaterial ? {unlit: true, albedoColor: colour.toLinearSpace()} :
                {disableLighting: true, emissiveColor: colour});
            await scene.whenReadyAsync();
            scene.render();
            seen[wall.material.getClassName()] = middle_of(canvas, view.size);
        }
        wall.dispose();
        sky.background();
        const shaders = BABYLON.Effect.ShadersStore;
        shaders.skybakeFragmentShader = shaders.skybakeFragmentShader.replace(/void main[^]*/, `void main() {
            gl_FragColor = vec4(srgb_of(skybake_exposure * linear_srgb(sky(normalize(ray)))), 1.0); }`);
        await scene.whenReadyAsync();
        scene.render();
        return {before_wall: seen.StandardMaterial, linear: seen.PBRMaterial, sky: middle_of(canvas, view.size)};
    },
};
