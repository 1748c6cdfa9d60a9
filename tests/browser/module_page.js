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

window.draw_by_module = {
    async three(folder, view) {
        const {sky, renderer, camera, scene} = await three_scene(folder, view);
        scene.add(sky.background());
        renderer.render(scene, camera);
        return renderer.domElement;
    },

    async babylon(folder, view) {
        const {Skybake} = await import('skybake/babylon');
        const canvas = canvas_of(view.size);
        const engine = new BABYLON.Engine(canvas, false, {preserveDrawingBuffer: true});
        const scene = new BABYLON.Scene(engine);
        const [x, y, z] = view.position, [ahead_x, ahead_y, ahead_z] = direction(view.pitch, view.heading);
        const camera = new BABYLON.FreeCamera('camera', new BABYLON.Vector3(x, z, y), scene);
        camera.setTarget(new BABYLON.Vector3(x + ahead_x, z + ahead_z, y + ahead_y));
        Object.assign(camera, {fov: vertical_field(view), minZ: 1, maxZ: 1e6});
        const sky = await Skybake.load(folder, scene);
        sky.set_sun(view.sun_elevation, view.sun_azimuth);
        sky.exposure = view.exposure;
        sky.background();
        await scene.whenReadyAsync();
        scene.render();
        return canvas;
    },
};

// The middle pixel of a wall that stands across the view, so many metres away, behind the air of three.js's module, and
// that of the sky: linear light as sRGB.
window.wall_behind_air = async (folder, view, distance) => {
    const {THREE, sky, renderer, camera, scene} = await three_scene(folder, view);
    const wall = new THREE.Mesh(new THREE.PlaneGeometry(4 * distance, 4 * distance),
        sky.add_air(new THREE.MeshBasicMaterial({color: view.wall, side: THREE.DoubleSide})));
    wall.quaternion.copy(camera.quaternion);
    wall.position.copy(camera.position).addScaledVector(camera.getWorldDirection(new THREE.Vector3()), distance);
    scene.add(wall);
    renderer.render(scene, camera);
    const pixel = () => {
        const context = canvas_of(view.size).getContext('2d');
        context.drawImage(renderer.domElement, 0, 0);
        return [...context.getImageData(view.size[0] / 2, view.size[1] / 2, 1, 1).data].slice(0, 3);
    };
    const before_wall = pixel();
    // The same by a shader of one's own, which has the module's functions.
    const own = sky.background();
    own.material.fragmentShader = `in vec3 ray;\nout vec4 color;\n${sky.glsl}
        void main() { color = vec4(srgb_of(skybake_exposure * linear_srgb(sky(normalize(ray)))), 1.0); }`;
    scene.remove(wall);
    scene.add(own);
    renderer.render(scene, camera);
    return {before_wall, sky: pixel()};
};
