// Rock is seldom bare: films of algae on faces that look up, pink crusts in the shade, in patches of
// the size of a hand to an arm. mottle: lightness, turf, crust; tone: of the grit; patches and crest: 0
// to 1.
vec3 rockColour(vec3 mottle, float tone, float patches, float crest) {
    vec3 stone = mix(vec3(0.13, 0.10, 0.075), vec3(0.46, 0.37, 0.27), mottle.x) * tone;
    vec3 turf = mix(vec3(0.14, 0.10, 0.03), vec3(0.36, 0.22, 0.08), smoothstep(0.3, 0.8, patches)) * tone;
    vec3 crust = mix(vec3(0.44, 0.14, 0.16), vec3(0.66, 0.34, 0.32), crest) * (0.6 + 0.4 * tone);
    vec3 colour = mix(stone, turf, 0.75 * smoothstep(0.35, 0.85, mottle.y + 0.9 * (patches - 0.5)));
    return mix(colour, crust, 0.9 * smoothstep(0.36, 0.56, 0.75 * mottle.z + 0.55 * (crest - 0.4)));
}
