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
    // groups.rs
    driving_link(name) = "driving link {name}";
    group_of_class(class, order, letters, bodies) = "class {class}, order {order}{letters}: {bodies}";
    hangs_by(joints) = "outer joints {joints}";
    joint_on_link(joint, link) = "{joint} on {link}";
    inner_joints(joints) = "; inner joints {joints}";
    coupled_by(name) = "coupled by {name}";
    NO_DEFINITE_POSITION = "the position of some links is not determined";
    // positions.rs
    THE_OTHER_POSITIONS = "the other positions";
    // view.rs
    paths_without_numbers(names) = "paths too small for numbers: {names}";
    // paths.rs
    the_font_lacks(letters) = "boxes are drawn for letters that the font of bitmaps and PDF lacks: {letters}";
    WRITE_AN_SVG = "write an SVG (the viewing program supplies its letters), or use only Latin, Greek or Cyrillic letters";
    // plot/panel.rs
    the_chart_cannot_be_drawn(error) = "the chart cannot be drawn: {error}";
    // paper/document.rs
    LIBERATION_SANS_ARIAL_HELVETICA_SANS = "Liberation Sans, Arial, Helvetica, sans-serif";
}
