// The view that pages show, the block of uniforms that the shaders take of it, and sliders that change it.
// Azimuths and headings turn from +x towards +y.

export const first_view = {position: [0, 0, 200], heading: 63, pitch: 15, fov: 70, sun_elevation: 20, sun_azimuth: 175,
    exposure: 12, size: [640, 360]};                                        // m, degrees, pixels

// The block `View` by the rules that std140, HLSL and WGSL share: a vector of three begins at a multiple of 16 bytes.
export function uniforms_of(view) {
    const radians = Math.PI / 180;
    const direction = (elevation, azimuth) => [Math.cos(elevation * radians) * Math.cos(azimuth * radians),
        Math.cos(elevation * radians) * Math.sin(azimuth * radians), Math.sin(elevation * radians)];
    return new Float32Array([
        ...view.position, Math.tan(0.5 * view.fov * radians),
        ...direction(view.pitch, view.heading), view.exposure,
        ...direction(0, view.heading - 90), 0,
        ...direction(view.pitch + 90, view.heading), 0,
        ...direction(view.sun_elevation, view.sun_azimuth), 0,
        ...view.size, 0, 0]);
}

const ranges = {sun_elevation: [-6, 90], sun_azimuth: [0, 360], heading: [0, 360], pitch: [-30, 60], exposure: [1, 60]};

export function show_with_sliders(element, draw) {
    const view = {...first_view};
    for (const [name, [min, max]] of Object.entries(ranges)) {
        const label = element.appendChild(document.createElement('label'));
        const slider = Object.assign(document.createElement('input'), {type: 'range', min, max, value: view[name]});
        label.append(`${name.replace('_', ' ')} `, slider);
        slider.oninput = () => {
            view[name] = Number(slider.value);
            requestAnimationFrame(() => draw(view));
        };
    }
    draw(view);
}
