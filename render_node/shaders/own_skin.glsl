// What a fish wears: the skin of its species. drawn_skin.glsl takes its place for fish that wear a
// drawing. In: a point of the skin or of a fin. Out: as the species' skin shader has it.
Skin wornGround(SkinPoint at) { return groundOf(at); }
void addWornDetails(inout Skin skin, SkinPoint at) { addDetails(skin, at); }
Fin wornFin(FinPoint fin, Skin root) { return finOf(fin, root); }
