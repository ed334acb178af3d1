// Moorish idol, Zanclus cornutus: black, white and yellow upright bars that continue over the fins.
// Members as skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_MOORISH_IDOL_GLSL
#define SKIN_MOORISH_IDOL_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.13, 0.085, 0.03), vec3(0.45, 0.26, 0.05), 0.55, 1.0);
const vec3 kMilk = vec3(0.82, 0.81, 0.68), kLemon = vec3(0.86, 0.58, 0.035),
           kBlack = vec3(0.014, 0.015, 0.018), kPale = vec3(0.58, 0.72, 0.78);

// The front bar's rear edge leans; it broadens downwards over half of the belly.
float slantOf(SkinPoint at) { return at.s + 0.075 * at.v - 0.018 * (1.0 - at.v * at.v); }

vec3 bars(SkinPoint at) {
    float soft = edgeOf(at), v = at.v;
    float lemon = ownBetween(at.id, 4u, 0.75, 1.0);
    float front = smoothstep(0.121 - soft, 0.121 + soft, at.s - 0.030 * v + 0.035 * v * v) *
                  falling(0.336 - soft, 0.336 + soft, slantOf(at));
    float rearFrom = at.s + 0.030 * v * v - 0.01 * v;
    float rear = smoothstep(0.606 - soft, 0.606 + soft, rearFrom) *
                 falling(0.730 - soft, 0.730 + soft, at.s + 0.004 * v);
    float yellow = smoothstep(0.38, 0.585, at.s + 0.02 * v);
    vec3 colour = mix(kMilk, kLemon, lemon * (0.08 + 0.90 * yellow));
    colour = mix(colour, kLemon, 0.9 * smoothstep(0.715, 0.75, at.s));
    // A thin pale line before the rear bar.
    colour = mix(colour, kMilk, 0.8 * line(rearFrom - 0.600, 0.005, at.pixel));
    return mix(colour, kBlack, max(front, rear));
}

Skin groundOf(SkinPoint at) {
    vec3 colour = bars(at);
    float soft = edgeOf(at);
    float ends = falling(0.70, 0.95, abs(at.v));
    colour = mix(colour, kPale, 0.8 * ends * line(slantOf(at) - 0.312, 0.0035, at.pixel));
    colour = mix(colour, kPale, line(at.s - 0.742, 0.006, at.pixel));
    // The snout: white, an orange saddle with a black rim, a black chin.
    vec2 saddle = vec2((at.s - 0.070) / 0.036, (at.y - 0.036 - 0.55 * (at.s - 0.070)) / 0.024);
    float from = length(saddle), rim = 20.0 * soft;
    colour = mix(colour, kBlack, falling(1.16 - rim, 1.16 + rim, from));
    colour = mix(colour, vec3(0.90, 0.31, 0.015), falling(0.92 - rim, 0.92 + rim, from));
    float chin = falling(-0.52, -0.30, at.v) * smoothstep(0.035, 0.06, at.s) * falling(0.13, 0.17, at.s);
    colour = mix(colour, kBlack, chin);
    colour = mix(colour, vec3(0.10, 0.06, 0.04), falling(0.004, 0.012, at.s));
    Skin skin = skinOf(colour, 0.55, 0.8);
    return skin;
}

void addDetails(inout Skin skin, SkinPoint at) {
    // Skin like fine sandpaper, each grain catching the light; the bars are velvet.
    float fine = grain(at, 0.0034);
    skin.albedo *= 0.90 + 0.20 * fine;
    skin.tilt += 0.16 * (vec2(fine, grain(at, 0.0041)) - 0.5);
    // Faint ribs of muscle under the white.
    float ribs = sin(6.2831853 * (at.s + 0.35 * at.v * at.v * 0.2) / 0.021);
    skin.albedo *= 1.0 + 0.025 * ribs * seenAt(0.021, at.pixel) * smoothstep(0.30, 0.36, at.s);
    paintLateralLine(skin, at, 0.165 * bell(at.s, 0.42, 0.20) * falling(0.55, 0.75, at.s), 0.28, 0.14);
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.118, 0.062), 0.0026);
    shadeUnderFin(skin, at, vec2(0.34, -0.055), vec2(0.05, 0.035));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q;
    if (fin.part == kPectoral) return Fin(vec3(0.55, 0.57, 0.52), 0.26, 18.0, 0.0, 0.5);
    if (fin.part == kPelvic) return Fin(kBlack, 0.95, 6.0, 0.0, 0.2);
    if (fin.part == kCaudal) {
        vec3 colour = mix(kLemon, kBlack, smoothstep(0.05, 0.10, q));
        return Fin(mix(colour, vec3(0.82, 0.84, 0.84), smoothstep(0.86, 0.90, q)), 0.94, 16.0, 0.0, 0.25);
    }
    // Bars go on along the rays: by where a ray is rooted, not by where it ends.
    vec3 colour = fin.part == kFirstDorsal ? kMilk : mix(kMilk, kLemon, smoothstep(0.28, 0.60, fin.p));
    float black = smoothstep(0.60, 0.625, fin.p - 0.05 * q) * falling(0.88, 0.90, fin.p - 0.02 * q);
    colour = mix(colour, kLemon, smoothstep(0.50, 0.60, fin.p) * (fin.part == kFirstDorsal ? 0.35 : 0.8));
    colour = mix(colour, kBlack, black);
    colour = mix(colour, kLemon, smoothstep(0.885, 0.905, fin.p - 0.02 * q));
    colour = mix(colour, kMilk, smoothstep(0.93, 0.97, q));
    colour = mix(root.albedo, colour, smoothstep(0.0, 0.12, q));
    float opacity = mix(0.80, 0.94, black);
    return Fin(colour, opacity, fin.part == kFirstDorsal ? 46.0 : 36.0, 0.13, 0.28);
}
#endif
