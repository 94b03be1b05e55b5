//! Every sentence that this crate can show. All sentences are in one place, so that they can be read as a list.

linkage::sentences! {
    // bitmap/canvas.rs
    THERE_IS_NO_MEMORY_FOR_THE_PICTURE = "not enough memory for the picture";
    GIVE_A_WIDTH_BETWEEN_AND_PIXELS = "give a width between 100 and 4000 pixels";
    a_picture_of_by_pixels_is_asked(pixels, rows) = "a picture of {pixels} by {rows:.0} pixels is requested";
    // bitmap/encode.rs
    GIVE_A_SMALLER_WIDTH = "give a smaller width";
    a_gif_has_at_most_pixels(width) = "a GIF has at most 65535 pixels in a row, but {width} are requested";
    IT_HAS_NO_PIXELS = "it has no pixels";
    could_not_be_made(what, error) = "{what} could not be created: {error}";
    // paper/document.rs
    LIBERATION_SANS_ARIAL_HELVETICA_SANS = "Liberation Sans, Arial, Helvetica, sans-serif";
}
