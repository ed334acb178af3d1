// How many places softening reads about each pixel: of a wall's picture.
const int kTaps = 16;
