// A corner of a rock: where it is, and how open to the light.
// To be included after the attributes of a rock's vertex shader. Out: world metres; tint and
// occlusion as shares.
struct RockCorner {
    vec3 place, normal, tint;
    vec2 open;  // to the sun, to the light from above
};
RockCorner rockCorner() {
    Instance one = instances[chosen];
    // Pebbles shrink before they vanish.
    float shown = smoothstep(4.0, 7.0, detail * pixelsOf(one.placeAndScale));
    float scale = shown * one.placeAndScale.w;
    RockCorner it;
    it.place = one.placeAndScale.xyz + scale * turned(one.turn, position);
    it.normal = turned(one.turn, normalAndRoughness.xyz);
    it.tint = one.tintAndSway.rgb;
    float above = (it.place.y - one.sandHeightMetres) / min(one.placeAndScale.w, 1.0);
    float contact = mix(0.4, 1.0, smoothstep(-0.1, 0.6, above));
    float own = mottleAndSky.w;
    it.open = vec2(one.occlusion.x * mix(0.3, 1.0, own), one.occlusion.y * own * sqrt(own) * contact);
    return it;
}
