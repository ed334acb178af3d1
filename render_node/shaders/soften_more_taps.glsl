// How many places softening reads about each pixel: of a picture that is finer than the wall's, where
// fewer would show a bright speck as many.
const int kTaps = 256;
