// Lookups of asset = "bruneton": its tables of scattering (scattering, single_mie, higher_orders) and of
// irradiance, in the layout of Bruneton's implementation of 2017; transmittance.glsl has the third kind.
// Use a clamped, trilinear sampler.
//
//     sky = scattering.rgb * rayleigh_phase(nu) + single_mie.rgb * mie_phase(nu, g)
//
// R is the ground's radius, D the thickness of the air, h the altitude, from 0 to D, all in km; mu and
// mu_s are the cosines of the zenith angles of the view ray and of the sun, nu that of the angle between
// them. `ground` says that the view ray meets the ground. mu_s_min and nu_size are the recipe's
// sun_cos_zenith_min and nu_size, and `size` are the texels of the file. A difference of squared radii would
// lose half of the light below 10 m in float: these forms keep the altitude.

// From the ground to the top of the air, over the range that it has for suns above the horizon.
float bruneton_sun(float R, float D, float H, float mu_s) {
    float s = R * mu_s, root = sqrt(s * s + H * H);
    return ((s > 0.0 ? H * H / (root + s) : root - s) - D) / (H - D);
}

// The place of x, from 0 to 1, in a row of texels: from the centre of the first to that of the last.
float bruneton_centre(float x, float size) { return x * (1.0 - 1.0 / size) + 0.5 / size; }

// Cost: fetches 2, operations 85, divisions 6, special functions 4
vec4 bruneton_scattering(sampler3D table, vec3 size, float R, float D, float h, float mu, float mu_s,
                         float nu, bool ground, float mu_s_min, float nu_size) {
    float half_mu = size.y / 2.0;                                           // texels of one half
    float H = sqrt(D * (2.0 * R + D)), rho = sqrt(h * (2.0 * R + h)), s = (R + h) * mu, v;
    if (ground) {
        float d = rho * rho / (sqrt(max(s * s - rho * rho, 0.0)) - s);      // the length of the ray
        float x = rho > h ? (d - h) / (rho - h) : 0.0;
        v = 0.5 - 0.5 * bruneton_centre(clamp(x, 0.0, 1.0), half_mu);
    } else {
        float q = (D - h) * (2.0 * R + D + h), root = sqrt(s * s + q);
        float d = s > 0.0 ? q / (root + s) : root - s, d_min = D - h;
        float x = (d - d_min) / (rho + H - d_min);
        v = 0.5 + 0.5 * bruneton_centre(clamp(x, 0.0, 1.0), half_mu);
    }
    float a = bruneton_sun(R, D, H, mu_s), A = bruneton_sun(R, D, H, mu_s_min);
    float u = bruneton_centre(max(1.0 - a / A, 0.0) / (1.0 + a), size.x / nu_size);
    float w = bruneton_centre(rho / H, size.z);
    float x = 0.5 * (nu + 1.0) * (nu_size - 1.0), i = clamp(floor(x), 0.0, nu_size - 2.0);
    vec4 low = texture(table, vec3((i + u) / nu_size, v, w));
    vec4 high = texture(table, vec3((i + 1.0 + u) / nu_size, v, w));
    return mix(low, high, x - i);
}

// Irradiance by the sky without the sun, times the solar irradiance.
// Cost: fetches 1, operations 7, divisions 0, special functions 0
vec4 bruneton_irradiance_of_4(sampler2D table, vec2 size, float D, float h, float mu_s) {   // of four wavelengths
    vec2 place = vec2(0.5 + 0.5 * mu_s, h / D);
    return texture(table, place * (1.0 - 1.0 / size) + 0.5 / size);
}

vec3 bruneton_irradiance(sampler2D table, vec2 size, float D, float h, float mu_s) {
    return vec3(bruneton_irradiance_of_4(table, size, D, h, mu_s));
}

// In 1/sr: Rayleigh's phase function, and that of Cornette and Shanks.
float rayleigh_phase(float nu) { return 0.0596831037 * (1.0 + nu * nu); }
float mie_phase(float nu, float g) {
    float k = 0.119366207 * (1.0 - g * g) / (2.0 + g * g), b = 1.0 + g * g - 2.0 * g * nu;
    return k * (1.0 + nu * nu) / (b * sqrt(b));
}
