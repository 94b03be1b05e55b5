//! All messages that this crate can show, in one file, so that they can be read as a list.

linkage::sentences! {
    // text.rs
    WRITE_DECIMALS_WITH_A_POINT = "write decimals with a point; leave a cell empty where there is no measured value";
    in_the_column_stands_which_is_no_number(names, cell) = "column \"{names}\": expected a number, found \"{cell}\"";
    GIVE_EVERY_ROW_AS_MANY_CELLS = "give every row as many cells as the header";
    the_row_has_cells_but_the_first(count, names) = "the row has {count} cells, but the first line has {names}";
    GIVE_A_TABLE_WITH_A_HEADER = "give a table with a header and one row per instant";
    THE_TABLE_IS_EMPTY = "the table is empty";
    the_columns_and_of_the_table(first, second, name) = "the columns {first} and {second} of the table are both called \"{name}\"";
    GIVE_EVERY_COLUMN_A_NAME = "give every column a unique name, or remove one of the two columns";
    row_of_the_table(row) = "row {row} of the table";
    line_of_the_table(line) = "line {line} of the table";
}
