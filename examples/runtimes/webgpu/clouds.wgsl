// The clouds of recipe.toml, lit by the sun and the sky: a march that leaps by the baked grid, and one from
// each sample towards the sun. cloud_table and cells_table are the textures. `camera` is in metres, z is the
// altitude.
const STEP = 23.4;                                                          // m; a voxel
const UP_STEP = 47.0;                                                       // m; two voxels
const OPAQUE = 0.002;
const SKY_OF_CLOUDS = 12;                                                   // steps through the air before them
const OCTAVES = 8;

fn base() -> f32 { return baked_cloud_corner_m().z; }                       // of the recipe
fn top() -> f32 { return base() + baked_cloud_extent_m().z; }

// Droplets of 12 um: Henyey-Greenstein's and Draine's functions (Jendersie and d'Eon 2023). Light that is
// scattered n more times sees them wider by 2^-n (Wrenninge et al. 2013). u is 1 - cosine.
fn henyey_greenstein(g: f32, u: f32) -> f32 {
    let b = (1.0 - g) * (1.0 - g) + 2.0 * g * u;
    return (1.0 - g * g) / (4.0 * PI * b * sqrt(b));
}
fn droplets(u: f32, wide: f32) -> f32 {
    let g = 0.56686 * wide;
    let alpha = 23.385 * wide;
    let c = 1.0 - u;
    let draine = henyey_greenstein(g, u) * (1.0 + alpha * c * c) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0);
    return mix(henyey_greenstein(0.99045 * wide, u), draine, 0.48742);
}

// The optical depth from p to the top or the base of the layer, along a ray that rises or falls.
fn depth_along(p: vec3f, ray: vec3f, stride: f32) -> f32 {
    let way = (select(base(), top(), ray.z > 0.0) - p.z) / ray.z;
    return baked_cloud_extinction_per_m() *
        baked_cells_march(cloud_table, cloud_sampler, cells_table, p + ray * 0.5 * stride, ray, stride,
                                          i32(way / stride));
}

struct Clouds { light: vec3f, through: f32, distance: f32 }                 // distance in metres

// `noise` in [0, 1) shifts the samples of a pixel.
fn clouds_along(camera: vec3f, ray: vec3f, sun: vec3f, reach: f32, noise: f32) -> Clouds {
    let faces = (vec2f(base(), top()) - camera.z) / ray.z;                      // infinite for a level ray
    let first = max(min(faces.x, faces.y), 0.0);
    let last = min(max(faces.x, faces.y), reach);
    let u = 0.5 * dot(ray - sun, ray - sun);
    var octaves: array<f32, OCTAVES>;
    var bright = 1.0;
    var wide = 1.0;
    for (var n = 0; n < OCTAVES; n++) {
        octaves[n] = bright * droplets(u, wide);
        bright *= 0.7;
        wide *= 0.5;
    }
    const km = 1e-3;
    let low = R + base() * km;
    let high = R + top() * km;
    let sun_low = sunlight(base() * km, low * sun.z);
    let sun_high = sunlight(top() * km, high * sun.z);
    let from_sky = skylight(top() * km, high * sun.z);
    let from_ground = ground(R * sun.z);
    var seen = Clouds(vec3f(0.0), 1.0, 0.0);
    var weights = 0.0;
    var t = (ceil(first / STEP - noise) + noise) * STEP;
    while (t < last && seen.through > OPAQUE) {
        let p = camera + ray * t;
        let empty = baked_cells_leap(cloud_table, cells_table, p, ray);
        if (empty > 0.0) {
            t += STEP * max(floor(empty / STEP), 1.0);                      // the sample before the box's face
            continue;
        }
        let density = baked_cloud(cloud_table, cloud_sampler, p);
        if (density > 0.0) {
            var depth = 1e9;
            if (sun.z > 0.0) { depth = depth_along(p, sun, STEP); }
            var lit = 0.0;
            for (var n = 0; n < OCTAVES; n++) {
                lit += octaves[n] * exp(-depth);
                depth *= 0.5;
            }
            // Diffuse light comes through layers by two-stream theory (Bohren 1987), g = 0.869.
            let above = depth_along(p, vec3f(0.0, 0.0, 1.0), UP_STEP);
            let below = depth_along(p, vec3f(0.0, 0.0, -1.0), UP_STEP);
            let light = lit * mix(sun_low, sun_high, (p.z - base()) / (top() - base())) +
                        from_sky / (2.0 + 0.131 * above) +
                        from_ground / (2.0 + 0.131 * below) * 2.0 / (2.0 + 0.131 * (above + below));
            let passed = exp(-baked_cloud_extinction_per_m() * density * STEP);
            let weight = seen.through * (1.0 - passed);
            seen.light += weight * light;
            seen.distance += weight * t;
            weights += weight;
            seen.through *= passed;
        }
        t += STEP;
    }
    seen.distance /= max(weights, 1e-9);
    return seen;
}
