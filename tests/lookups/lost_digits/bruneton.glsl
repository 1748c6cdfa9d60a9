// The lookup that was published once, and fails: differences of squared radii lose the ground. The tests
// show that they would notice.
const float R_GROUND = 6360.0, R_TOP = 6460.0, MU_S_MIN = -0.2, NU = 4.0;
const vec3 SIZE = vec3(16.0, 64.0, 16.0);

// x in [0, 1] to a texture coordinate with end points on texel centres.
float centred(float x, float n) { return 0.5 / n + x * (1.0 - 1.0 / n); }

// r, mu, mu_s, nu as in Bruneton 2017; ground: the view ray meets it. SIZE = (mu_s, mu, r), NU sub-images.
vec4 lookUpScattering(sampler3D table, float r, float mu, float mu_s, float nu, bool ground) {
    float H = sqrt(R_TOP * R_TOP - R_GROUND * R_GROUND);
    float rho = sqrt(max(r * r - R_GROUND * R_GROUND, 0.0));
    float disc = r * r * (mu * mu - 1.0) + R_GROUND * R_GROUND;
    float v;
    if (ground) {
        float d = -r * mu - sqrt(max(disc, 0.0)), dMin = r - R_GROUND;
        float x = rho > dMin ? (d - dMin) / (rho - dMin) : 0.0;
        v = 0.5 - 0.5 * centred(x, SIZE.y / 2.0);
    } else {
        float d = -r * mu + sqrt(max(disc + H * H, 0.0)), dMin = R_TOP - r;
        v = 0.5 + 0.5 * centred((d - dMin) / (rho + H - dMin), SIZE.y / 2.0);
    }
    float dMin = R_TOP - R_GROUND;
    float D = -R_GROUND * mu_s + sqrt(R_GROUND * R_GROUND * (mu_s * mu_s - 1.0) + R_TOP * R_TOP);
    float Dm = -R_GROUND * MU_S_MIN + sqrt(R_GROUND * R_GROUND * (MU_S_MIN * MU_S_MIN - 1.0) + R_TOP * R_TOP);
    float a = (D - dMin) / (H - dMin), A = (Dm - dMin) / (H - dMin);
    float u = centred(max(1.0 - a / A, 0.0) / (1.0 + a), SIZE.x);
    float w = centred(rho / H, SIZE.z);
    float x = 0.5 * (nu + 1.0) * (NU - 1.0), i = min(floor(x), NU - 2.0);
    return mix(vec4(texture(table, vec3((i + u) / NU, v, w))),
               vec4(texture(table, vec3((i + 1.0 + u) / NU, v, w))), x - i);
}
