// The air of recipe.toml, marched by its two tables (Hillaire 2020): sky, ground, the sun's disc, and what
// the air adds and takes up to some distance. The camera is h km above the ground, z is up, and light is
// per unit of solar irradiance. transmittance_table and multiple_scattering_table are the textures.
//
// `skybake show recipe.toml atmosphere` prints these numbers. Coefficients are per km.
const R = 6360.0;
const D = 100.0;
const ALBEDO = 0.3;
const PI = 3.14159265;
const RAYLEIGH = vec3f(5.802e-3, 1.3558e-2, 3.31e-2);
const OZONE = vec3f(6.5e-4, 1.881e-3, 8.5e-5);
const MIE = 3.996e-3;
const MIE_EXTINCTION = 4.44e-3;
const MIE_G = 0.8;
const SKY_STEPS = 40;
// Legendre moments of the two phase functions below, as examples/lookups/moments.glsl takes them.
const RAYLEIGH_MOMENTS = vec3f(1.0, 0.0, 0.1);
const MIE_MOMENTS = vec3f(1.0, 0.8436, 0.7097);

// Rayleigh's phase function, and that of Cornette and Shanks, in 1/sr.
fn rayleigh_phase(nu: f32) -> f32 { return 0.0596831037 * (1.0 + nu * nu); }
fn mie_phase(nu: f32, g: f32) -> f32 {
    let b = 1.0 + g * g - 2.0 * g * nu;
    return 0.119366207 * (1.0 - g * g) / (2.0 + g * g) * (1.0 + nu * nu) / (b * sqrt(b));
}

// Sunlight at an altitude; s is the radius times the cosine of the sun's zenith angle there.
fn sunlight(h: f32, s: f32) -> vec3f {
    if (s < -sqrt(h * (2.0 * R + h))) { return vec3f(0.0); }                // the planet hides it
    return baked_transmittance(transmittance_table, transmittance_sampler, h, s / (R + h));
}

// The mean radiance of the sky there. The table has that of all directions, half of which are ground.
fn skylight(h: f32, s: f32) -> vec3f {
    let sun = max(s / (R + h), 0.0) * sunlight(h, s) / PI;
    let mean = baked_multiple_scattering(multiple_scattering_table, multiple_scattering_sampler, h, s / (R + h), 0);
    return max(2.0 * mean - ALBEDO * sun, vec3f(0.0)) / (1.0 + ALBEDO);
}

fn ground(s: f32) -> vec3f { return ALBEDO * (max(s / R, 0.0) * sunlight(0.0, s) / PI + skylight(0.0, s)); }

// What a km of air scatters again towards the eye. mu is the cosine of the view's zenith angle there, sun_mu
// that of the sun's, and nu that of the angle between them.
fn scattered_air(h: f32, density: vec2f, mu: f32, sun_mu: f32, nu: f32) -> vec3f {
    let sines = sqrt(max((1.0 - mu * mu) * (1.0 - sun_mu * sun_mu), 0.0));
    let along = nu - mu * sun_mu;
    var c = sign(along);                                                    // a vertical has no azimuth
    if (abs(along) < sines) { c = along / sines; }
    return density.x * RAYLEIGH * baked_multiple_scattering_scattered(multiple_scattering_table, multiple_scattering_sampler,
                                                                      h, sun_mu, mu, c, RAYLEIGH_MOMENTS)
         + density.y * MIE * baked_multiple_scattering_scattered(multiple_scattering_table, multiple_scattering_sampler,
                                                                 h, sun_mu, mu, c, MIE_MOMENTS);
}

struct Air { light: vec3f, through: vec3f }

// Along `ray` as far as `reach` km, or to its end at the ground or at the top, where through is the share
// of light that comes from there. Segments are short where the air is dense.
fn air_along(h: f32, ray: vec3f, sun: vec3f, reach: f32, steps: i32) -> Air {
    let r = R + h;
    let s = r * ray.z;
    let rho2 = h * (R + r);
    let rise = (D - h) * (R + D + r);
    let nu = dot(ray, sun);
    let falls = s < -sqrt(rho2);
    var end = sqrt(s * s + rise) - s;
    if (falls) { end = rho2 / (sqrt(s * s - rho2) - s); }
    let densest = min(select(max(-s, 0.0), end, falls), reach);
    let begin = -sqrt(densest);
    let range = sqrt(min(end, reach) - densest) - begin;
    let rayleigh = RAYLEIGH * rayleigh_phase(nu);
    let mie = MIE * mie_phase(nu, MIE_G);
    var near = begin * abs(begin);
    var air = Air(vec3f(0.0), vec3f(1.0));
    for (var i = 1; i <= steps; i++) {
        let y = begin + range * f32(i) / f32(steps);
        let far = y * abs(y);
        let width = far - near;
        let t = densest + 0.5 * (near + far);
        let q = t * (t + 2.0 * s);
        let altitude = clamp(h + q / (sqrt(r * r + q) + r), 0.0, D);
        let sun_s = r * sun.z + t * nu;
        let density = exp(-altitude / vec2f(8.0, 1.2));
        let extinction = density.x * RAYLEIGH + density.y * MIE_EXTINCTION +
                         max(1.0 - abs(altitude - 25.0) / 15.0, 0.0) * OZONE;
        let source = (density.x * rayleigh + density.y * mie) * sunlight(altitude, sun_s) +
                     scattered_air(altitude, density, (s + t) / (R + altitude), sun_s / (R + altitude), nu);
        let passed = exp(-extinction * width);
        air.light += air.through * source * (1.0 - passed) / extinction;
        air.through *= passed;
        near = far;
    }
    return air;
}

// Returns the light that the camera sees where there is no cloud.
fn sky(h: f32, ray: vec3f, sun: vec3f) -> vec3f {
    let s = (R + h) * ray.z;
    let rho2 = h * (2.0 * R + h);
    let air = air_along(h, ray, sun, 1e9, SKY_STEPS);
    if (s < -sqrt(rho2)) {
        let end = rho2 / (sqrt(s * s - rho2) - s);
        return air.light + air.through * ground((R + h) * sun.z + end * dot(ray, sun));
    }
    const SUN = 4.653e-3;                                                   // the disc's radius
    return air.light + select(vec3f(0.0), air.through / (PI * SUN * SUN), length(ray - sun) < SUN);
}
