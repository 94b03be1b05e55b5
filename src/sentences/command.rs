//! Sentences of the command line, the only part that names options and commands.

linkage::sentences! {
    // cli/run/session.rs
    NEXT_AGREE =
        "next       `linkproof run FILE --verbose` shows every check and bound,\n           \
         `linkproof run FILE -o PAGE.html` motion, curves and formulas,\n           \
         `linkproof bearings FILE` the loads of the joints";
    NEXT_OPEN =
        "next       follow the advice above, or allow more work: `--budget 1e9`;\n           \
         `linkproof run FILE --verbose` shows every bound";
    NEXT_DISAGREE =
        "next       correct the causes above, the first one first;\n           \
         `linkproof run FILE -o PAGE.html` shows the curves of both sides";
    // cli/accept.rs
    linkproof_accept_writes_it(file) = "`linkproof accept {file}` writes this file";
    nothing_was_accepted_of_there(file, place) = "{file} has no accepted figures: {place} does not exist";
    // cli/export.rs
    MIMIC_IS_A_MATTER_OF_URDF = "only a .urdf has the relations of --mimic";
    WRITE_A_URDF = "give -o FILE.urdf as well, or leave --mimic out";
    // cli/inspect.rs
    THE_STRUCTURE_DOES_NOT_MOVE = "the file has no drive, so nothing moves";
    MODES_LISTS_THEM = "`--modes` lists the configurations, `linkproof draw --each-mode` draws them\n";
    TAKE_IT_OUT_OR_ADD_A_DRIVE = "leave the option out, or add a `[drive]`";
    there_is_no_link_or_joint_called(name) = "there is no link or joint \"{name}\"";
    did_you_mean(near) = "did you mean \"{near}\"? ";
    give_a_driving_link_or_a_joint(links, joints) = "give a link on the ground ({links}), a joint ({joints}), or `all`";
    THE_GROUND_IS_NO_DRIVING_LINK = "the ground stands still, so it cannot be the driving link";
    the_link_has_no_joint_with_the_ground(name) = "\"{name}\" has no joint with the ground, so it cannot be the driving link";
    give_a_link_on_the_ground_or_a_joint(links, joints) = "give a link on the ground ({links}); or drive this link relative to a neighbour, at one of its joints ({joints})";
    another_drive_moves_the_joint(joint) = "another drive already moves the joint \"{joint}\"";
    GIVE_A_JOINT_WITHOUT_A_FURTHER_DRIVE = "only the first drive is replaced: give a joint that no further drive moves";
    A_DRAWING_SHOWS_THE_GROUPS = "a drawing shows the groups of one structure";
    LEAVE_IT_OUT_OR_WRITE_JSON = "leave the option out, give one link, or write a .json";
    // cli/watch.rs
    watch_serves(address) = "page       {address}\n           open it in a browser; it follows the file. Ctrl-C ends it\n";
    the_page_cannot_be_served(port, found) = "the page cannot be served at port {port}: {found}";
    NAME_ANOTHER_PORT = "name another port, or leave the option out: the program then takes a free port";
    WATCH_IS_NOT_BUILT = "this build has no server for the page";
    BUILD_WITH_WATCH = "build with the cargo feature `watch`, or run `linkproof run FILE -o FILE.html` after each change";
    // cli/watch/work.rs
    THE_PROOF_RUNS = "The motion is solved analytically. The proof is running.";
    IT_IS_SHOWN_WITH_THE_VERDICT = "the reduced quantities are shown with the verdict";
    AN_INTERNAL_ERROR = "internal error: the program has stopped this calculation";
    REPORT_THE_FILE = "report the file to the authors";
    // cli/advice.rs
    such_as(name, to) = ", such as {name} {to}";
    LEAVE_THE_LOADS_OUT_WITH_NO_LOADS = "leave the loads out with --no-loads, and add them to the model by hand";
    ALL_OF_THEM_WITH_JSON = "-o FILE.json lists all results";
    ASK_FOR_A_LARGER_ERROR_OTHER = "ask for a larger error, other channels (--channel) or more engines (--engine all)";
    name_a_column_of_linkproof(groups) = "name a column of `linkproof solve`, such as joint.A.fx_N, or a group: {groups}";
    READ_THEM_OFF_A_TABLE_OF_LINKPROOF = "take the values from a table of `linkproof solve` instead";
    linkproof_inspect_file_modes_lists(advice) = "{advice}; `linkproof inspect FILE --modes` lists configurations";
    LINKPROOF_INSPECT_FILE_RANGE_SHOWS = "`linkproof inspect FILE --range` shows what limits the crank and which links turn fully";
    solve_the_scenario_with_linkproof(solver) = "solve the scenario with one side only: `linkproof solve FILE --with {solver}`";
    take_side_reference(solver) = "use side \"{solver}\" as the reference: --reference {solver}";
    take_another_way_to_the_reactions(options) = "choose another method for the reactions: {options}";
    linkproof_list_solvers_names_them(advice) = "{advice}: `linkproof list --solvers` lists the engines";
    allow_more_memory_such_as_memory(rounded_up) = "allow more memory, such as --memory {rounded_up:.1}";
    allow_more_work_such_as_budget(to) = "allow more work, such as --budget {to}";
    LEAVE_OUT_THE_ENGINE_SETTINGS = "leave out the engine settings; the run then chooses them";
    raise_the_number_of_sweeps(to) = "raise the number of sweeps, such as --sweeps {to}";
    RAISE_THE_NUMBER_OF_SWEEPS_SWEEPS = "raise the number of sweeps (--sweeps)";
    choose_a_looser_accuracy(option) = "choose a looser accuracy{option}";
    choose_a_tighter_accuracy(option) = "choose a tighter accuracy{option}";
    choose_a_larger_time_step(option) = "choose a larger time step{option}";
    choose_a_smaller_time_step(option) = "choose a smaller time step{option}";
    // cli/bearings.rs
    GIVE_A_NUMBER_ABOVE_ZERO = "give a number above zero";
    // cli/bench.rs
    GIVE_A_DIRECTORY_THAT_MAY = "name a directory that exists or can be created, and is writable";
    THEIR_FILES_IN_THE_DIRECTORY = "the output files of these scenarios would have the same names: write each scenario's files to a separate directory";
    two_scenarios_are_called(twice) = "two scenarios have the name \"{twice}\"";
    THE_COMMAND_IS_EMPTY = "the command is empty";
    is_no_name_letters_digits(name) = "\"{name}\" is not a valid name: use letters, digits, ., - and _";
    EXPECTED_NAME_COMMAND_FOR_EXAMPLE = "expected NAME=COMMAND, for example mujoco='python3 peer.py'";
    // cli/check.rs
    EXPECTED_NAME_EXPR_SUCH_AS_A_SIN = "expected NAME=EXPR, such as 'u=a*sin(phi)'";
    // cli/clearance.rs
    ADD_A_SECTION_CLEARANCE_FOR_EXAMPLE = "add a section `[clearance]`, for example with `radius_mm = 5` for all links; `linkproof docs scenario` describes it";
    the_scenario_asks_nothing_about(file) = "the scenario {file} has no section `[clearance]`";
    GIVE_ONE_SCENARIO_OR_WRITE = "give one scenario, or write JSON: -o FILE.json";
    scenarios_are_given_but_a_drawing(args) = "{args} scenarios are given, but a drawing or table shows one scenario";
    // cli/compare.rs
    comparing_rows(rows) = "comparing {rows} rows";
    the_table(path) = "the table {path}";
    LEAVE_IT_OUT = "leave it out";
    LEAVE_IT_OUT_OR_ADD_MODES = "leave the option out, add --modes, or write a drawing";
    ONLY_MODES_HAS_AN_INSTANT = "only --modes and drawings show an instant";
    NEITHER_OF_THE_TWO_IS_A_RECORDING = "neither A nor B is a recording";
    BOTH_ARE_SCENARIOS_WHICH_ARE_SOLVED = "A and B are scenarios: each is solved at the requested instants, so interpolation is not needed";
    MAP_IS_FOR = "use --map for B";
    A_IS_NO_TABLE = "A is not a table";
    SCENARIOS_AND_RECORDINGS_HAVE_CHANNELS = "leave the option out: scenarios and recordings already name their channels";
    NEITHER_OF_THE_TWO_IS_A_TABLE = "neither A nor B is a table";
    EXPECTED_CHANNEL_SIZE_SUCH_AS_POINT = "expected CHANNEL=SIZE, such as point.B.x_mm=0.01; the channel name states the unit";
    THIS_FILE_IS_NO_MAPPING_AND_WOULD = "this file is not a mapping and would be overwritten";
    A_MAPPING_FILE_ENDS_IN_TOML = "the name of a mapping file must end in .toml; --map recognises a mapping file by this ending";
    // cli/docs.rs
    the_page_has_no_section(name, anchor) = "the page \"{name}\" has no section \"{anchor}\"";
    there_is_no_page(name) = "there is no page \"{name}\"";
    // cli/draw.rs
    each_mode_draws_all_configurations(own) = "{own}: --each-mode draws all configurations, with their names";
    LEAVE_IT_OUT_OR_WRITE_A_PNG = "leave the option out, or write a .png, .gif or .webp";
    AN_SVG_HAS_NO_PIXELS = "an SVG, a PDF or a DXF has no pixels";
    WRITE_AN_SVG_OR_A_PNG = "write an SVG or a PNG";
    AN_ANIMATION_SHOWS_ONE_CONFIGURATION = "an animation shows one configuration, but all configurations are requested";
    LEAVE_IT_OUT_OR_WRITE_A_GIF = "leave the option out, or write a .gif or a .webp";
    THE_PICTURE_DOES_NOT_MOVE = "the picture is not animated";
    // cli/drive.rs
    NO_GRAPHS_OF_A_CHOICE = "the choice of a motor has no graphs";
    WRITE_JSON = "write the choice as .json, or leave out --catalogue";
    GIVE_OR_OR_LEAVE_IT_OUT = "give 3000 or 1500, or leave the option out";
    the_catalogue_has_no_motor(rpm) = "the catalogue has no motor with a synchronous speed of {rpm} rpm";
    GIVE_A_NUMBER_FROM_TO = "give a number from 1 to 1000000";
    points_is(points) = "--points is {points}";
    GIVE_A_NUMBER_OF_DEGREES = "give at least 0.00036 deg, such as 10: a table has at most 1000000 rows per turn";
    step_deg_is(step_deg) = "--step-deg is {step_deg}";
    // cli/engine_section.rs
    CHECK_THAT_THE_FILE_MAY_BE_WRITTEN = "check that the file is writable, or copy the section by hand";
    // cli/graph.rs
    TWO_LENGTHS_WITH_A_COMMA = "two lengths in millimetres with a comma, such as 160,70";
    expected_a_size(least, most) = "expected a width and a height from {least} to {most} mm, such as 160,70";
    is_an_analytic_side_and_no_engine(side) = "the solver {side} is an analytic side, but the second party must be an engine";
    name_an_engine_or_leave_with_out(engines) = "name an engine by --with ({engines}), or leave --with out";
    // cli/grid.rs
    is_not_a_number(part, expected) = "\"{part}\" is not a number; {expected}";
    is_not_finite(part, expected) = "\"{part}\" is not finite; {expected}";
    EXPECTED_FROM_TO_STEP_OR_VALUES = "expected FROM:TO:STEP or values separated by commas, for example 0:360:30 or 0,45,90";
    CHECK_THE_UNIT_AND_SIZE_OF_TIMES = "check the unit and size of --times";
    CHECK_THE_UNIT_AND_SIZE_OF_CRANK = "check the unit and size of --crank-deg";
    GIVE_TIMES_BY_TIMES_FROM_TO_STEP = "give times by --times FROM:TO:STEP";
    // cli/html.rs
    A_PAGE_GOES_TO_A_FILE_EXPECTED = "a page cannot go to standard output: expected a file, or a directory for several scenarios";
    NAME_ANOTHER_DIRECTORY_WITH_HTML = "name another directory with -o DIR/";
    the_directory_cannot_be_made(to, error) = "the directory {to} cannot be created: {error}";
    NAME_A_FILE_FOR_ONE_SCENARIO = "name a file for one scenario, or a directory for several";
    THE_PAGE_CANNOT_BE_WRITTEN = "the page cannot be written to";
    PAGES_CANNOT_BE_WRITTEN_TO = "pages cannot be written to";
    // cli/jobs.rs
    REPORT_IT_WITH_THE_SCENARIO = "report it with the scenario file; other files are not affected";
    this_is_a_fault_of_the_program(it) = "this is a bug in the program: {it}";
    // cli/list.rs
    NEW_WRITES_ONE = "`linkproof new` writes a scenario file, `linkproof new --shipped` writes the examples";
    NAME_THE_DIRECTORY_THAT_HOLDS = "name the directory that holds your scenario files: linkproof list DIR; `linkproof new --shipped` writes examples to scenarios/";
    // cli/live.rs
    LEAVE_OUT_LIVE_AND_OPEN_THE_RECORDING = "leave out --live, and open the recording: linkproof view FILE.mcap";
    BUILD_WITH_THE_CARGO_FEATURE = "build with the cargo feature \"live\": in the repository, `cargo install --path . --features live`";
    LIVE_IS_ASKED_FOR_BUT_THIS_BUILD = "--live is requested, but this build does not include it";
    NAME_ONE_FILE = "name one file";
    live_shows_one_scenario_but_are_given(files) = "--live shows one scenario, but {files} are given";
    // cli/live/server.rs
    ctrl_cannot_be_waited_for(found) = "cannot wait for Ctrl-C: {found}";
    live_lichtblick_or_foxglove_open(address, pace, layout) = "\nlive       {address}{pace}\n           Lichtblick or Foxglove: choose Open connection > Foxglove WebSocket, and enter this address;\n           Foxglove directly: https://app.foxglove.dev/?ds=foxglove-websocket&ds.url={address}\n           {layout}\n           Ctrl-C ends it\n";
    A_LAYOUT_IS_WRITTEN_BESIDE = "no layout: a layout is written beside a recording, but --no-record is set";
    then_layouts_import_from_file(layout) = "then choose Layouts > Import from file: {layout}";
    NAME_ANOTHER_ADDRESS_AS_LIVE = "name another address as --live=HOST:PORT; with port 0 the program takes a free port";
    viewers_cannot_be_served_at(address, found) = "viewers cannot be served at {address}: {found}";
    // cli/live/viewer.rs
    linkproof_speaks(known) = "linkproof supports {known}\n";
    // cli/load.rs
    has_two_numbers(key) = "`{key}` is given twice";
    GIVE_ONE_NUMBER = "give one number for each key";
    settings_cannot_be_written_to(name) = "settings cannot be written to {name}";
    SAVE_THE_SCENARIO_TO_A_FILE = "save the scenario to a file and name that file, or leave out --write: the report lists the settings";
    cannot_be_read(name, error) = "{name} cannot be read: {error}";
    GIVE_A_SCENARIO_AS_IN_LINKPROOF = "give a scenario, as in: linkproof run - < four_bar.toml";
    THE_SCENARIO_IS_READ_FROM_STANDARD = "the scenario is read from standard input, up to its end (Ctrl-D)";
    A_FINITE_NUMBER_BEHIND_THE_SUCH_AS_A_MM = "a finite number after the `=`, such as a_mm=30";
    EXPECTED_KEY_NUMBER_SUCH_AS_A_MM = "expected KEY=NUMBER, such as a_mm=30";
    // cli/mutate.rs
    THERE_IS_NO_SUCH_KIND_AND_NO_SUCH_FAMILY = "no kind and no family of faults has this name; `linkproof mutate --list` lists them all";
    GIVE_ONE_ENGINE = "give one engine";
    found_engines_but_faults_are_planted(options) = "found {options} engines, but faults are planted in one engine only";
    // cli/new.rs
    files_in(files, directory) = "{files} files in {directory}\n";
    CHECK_THAT_THIS_DIRECTORY_MAY = "check that this directory is writable";
    cannot_make_the_directory_of(path, error) = "cannot create the directory of {path}: {error}";
    NAME_ANOTHER_DIRECTORY_AS_IN_SHIPPED = "name another directory, as in --shipped DIR";
    is_written_nevertheless_to_be_corrected(path, template) = "{path} is written anyway, so that you can correct it: `linkproof draw {path} -o picture.svg` shows the joints that stay open. The template's own lengths fit together: {template}";
    the_source_cannot_be_read(path, error) = "the source {path} cannot be read: {error}";
    GIVE_AN_ADDRESS_OR_A_FILE = "give the path of a file, or an address in quotes, with its `?` and all that follows";
    the_import_is_to_be_completed(path) = "{path} is written anyway, so that you can complete it; `linkproof draw {path} -o picture.svg` shows what is there";
    next_after_a_file(what, file, svg, html) = "{what}\n\nnext  linkproof draw {file} -o {svg}\n      linkproof run {file} -o {html}\n";
    GIVE_ANOTHER_NAME_WITH_OUTPUT = "give another name with --output";
    or_replace_what_is_there(other) = "{other}, or overwrite it with --force";
    is_there_already(path) = "{path} already exists";
    linkproof_new_template_writes_one_its_dimensions(lines) = "{lines}\nlinkproof new TEMPLATE writes a scenario; set its dimensions in the file, or with --set\n";
    // cli/number.rs
    expected_decimals_take_a_point(such, replacen) = "expected {such}; write decimals with a point: {replacen}";
    expected_a_number_from_one_to(most) = "expected a whole number from 1 to {most}";
    expected_a_whole_number_from_to(most_times) = "expected a whole number from 0 to {most_times}";
    EXPECTED_A_WHOLE_NUMBER_FROM_ON = "expected a whole number of at least 1";
    A_NUMBER_ABOVE_AND_AT_MOST = "a number above 0 and at most 1, such as 0.92";
    A_NUMBER_BETWEEN_AND_SUCH_AS = "a number between 0 and 1, such as 1e-4";
    A_FINITE_NUMBER_THAT_IS_NOT = "a finite number that is not 0";
    A_FINITE_NUMBER_THAT_IS_OR_GREATER = "a finite number that is 0 or greater";
    A_FINITE_NUMBER_GREATER_THAN = "a finite number greater than 0";
    A_FINITE_NUMBER_SUCH_AS = "a finite number, such as 12.5";
    // cli/output.rs
    cannot_be_made(path, error) = "{path} cannot be created: {error}";
    CHECK_WHERE_IT_GOES_TO = "check where standard output goes";
    CHECK_THAT_THE_DIRECTORY_EXISTS = "check that the directory exists, is writable and has free space";
    GIVE_TWO_FILES_OR_LEAVE_ONE_OF_THE_TWO = "give two files, or leave one of the two out";
    two_results_go_to(to) = "two results go to {to}";
    and_both_name(one, other, to) = "{one} and {other} both name {to}";
    a_second_directory(path) = "a second directory, {path}, is given for the results\n  = help: give one directory\n";
    THIS_FILE_IS_NOT_OF_SYNTHESIZE = "this file was not written by `linkproof synthesize` and would be overwritten; name another file";
    THIS_IS_A_SCENARIO_FILE_AND_WOULD = "this is a scenario file and would be overwritten; expected a file for the results, or `-`";
    // cli/outputs.rs
    NO_ENDING = "no ending";
    expected_found(expected, found) = "expected {expected}; found {found}";
    is_standard_output_as(form) = " `-` writes {form} to standard output; `-.ENDING` writes another form to it.";
    write_to_a_file_by_its_ending(contents, standard) = "Write results to a file, by its ending: {contents}.{standard} May be given several times";
    // cli/outputs.rs: forms of drawings
    SVG_PDF_OR_PNG = ".svg, .pdf or .png";
    // cli/plan.rs
    LEAVE_OUT_CENTRES = "leave out --centres";
    has_links_and_centres_are_shown_for(name, links, most) = "{name} has {links} links with the ground, but instant centres are shown for at most {most}";
    LEAVE_OUT_POINTS_THAT_THE_PLAN = "leave out points that the plan does not need; `linkproof solve` gives the numbers of all points";
    has_points_and_a_plan_has_a_vector(name, count, points) = "link {name} has {count} points, but a link in a plan can have at most {points}: the plan has a vector for every pair of them";
    // cli/record_args.rs
    it_is_large_record_hz_would(fewer, files) = "\n           the recording is large; --record-hz {fewer} would reduce it to about {files}";
    THE_ENGINE_IS_AT_WORK_ITS_SIDE = "the engine is running; its results appear when the proof is done";
    it_is_kept_linkproof_view(why, path) = "\n           {why}: it is not overwritten;\n           linkproof view {path} --with foxglove -o OTHER.json writes a new one";
    mcap_is_of_another_run_and_is_kept(scenario, found) = "\n           {scenario}.mcap belongs to another run and is kept: {found}";
    NAME_ANOTHER_DIRECTORY_WITH_RECORD = "name another directory with --record, or use --no-record";
    NAME_ANOTHER_DIRECTORY_OR_USE = "name another directory, or use --no-record";
    recordings_cannot_be_written_to(record, found) = "recordings cannot be written to {record}: {found}";
    LEAVE_OUT_ONE_OF_THE_TWO = "leave out one of the two, or add --live";
    cannot_be_used_with_no_record(option) = "{option} cannot be used with --no-record: it only affects recordings and live views";
    // cli/run.rs
    viewers_can_listen_at_from_now(live) = "viewers can now connect to {live}";
    // cli/run/session.rs
    NOT_ASKED_FOR = "not requested";
    // cli/man.rs
    NAME_ANOTHER_DIRECTORY_WITH = "name another directory with -o";
    the_manual_cannot_be_written(to, error) = "the manual cannot be written to {to}: {error}";
    // cli/sensitivity.rs
    the_tolerance_is_not_above_zero(key, limit) = "the tolerance of `{key}` must be above zero; found {limit}";
    is_left_out_because(key, part) = "`{key}` is left out: `{part}` has no known derivative by this key";
    // cli/solving.rs
    leave_out_or_solve_with_one_of(option, name) = "leave out {option}, or solve --with one of: {name}";
    is_a_setting_of_an_engine(option, solver) = "{option} is an engine setting, but {solver} is an analytic solver";
    // cli/stress.rs
    linkproof_stress_out_dir_page(quick, to) = "linkproof stress{quick} -o DIR -o {to}";
    NAME_A_FILE_IN_A_DIRECTORY = "name a file in a writable directory";
    seed_of_points_were_run_the_others(text, seed, open, total, args) = "{text}Seed {seed}. {open} of {total} points were run, the results of the other points were already in {args}.\n";
    NAME_ANOTHER_DIRECTORY_OR_REMOVE = "name another directory, or remove the file or directory that is there";
    NAME_A_DIRECTORY_OR_A_PLACE = "name a directory that exists or can be created";
    // cli/synthesize/closed_form.rs
    SLIDER_CRANK_FROM_STROKE_AND_OFFSET = "Slider-crank from stroke and offset";
    linkproof_synthesize_slider_crank_stroke(stroke_mm, offset_mm, told) = "linkproof synthesize slider-crank --stroke-mm {stroke_mm} --offset-mm {offset_mm} {told}";
    CRANK_ROCKER_FROM_TWO_EXTREME = "Crank-rocker from two extreme positions of its rocker";
    linkproof_synthesize_crank_rocker_crank(crank_pivot_mm, crank_pivot_mm_2, pivot_mm, pivot_mm_2, rocker_mm, extreme_deg, swing_deg) = "linkproof synthesize crank-rocker --crank-pivot-mm {crank_pivot_mm},{crank_pivot_mm_2} --pivot-mm {pivot_mm},{pivot_mm_2} --rocker-mm {rocker_mm} --extreme-deg {extreme_deg} --swing-deg {swing_deg}";
    TWO_NUMBERS_WITH_A_COMMA = "two numbers separated by a comma, such as 150,15";
    // cli/synthesize/precision.rs
    linkproof_synthesize_precision(command, arguments) = "linkproof synthesize {command}{arguments}";
    THREE_NUMBERS_WITH_COMMAS = "three numbers separated by commas, such as 100,20,45";
    FUNCTION_GENERATOR_THROUGH_PAIRS = "Function generator: four-bar through pairs of crank and rocker angles";
    MOTION_GENERATOR_THROUGH_POSES = "Motion generator: four-bar through poses of its coupler";
    PATH_GENERATOR_THROUGH_POINTS = "Path generator: four-bar whose coupler point passes points at given crank angles";
    points_and_crank_angles_differ(points, cranks) = "found {points} points and {cranks} crank angles";
    GIVE_EVERY_POINT_ITS_CRANK_ANGLE = "give one --crank-deg for each --point-mm, in the same order";
    the_table_has_only(count, taken) = "four-bar {taken} is requested, but the table has {count}";
    TAKE_A_NUMBER_OF_THE_TABLE = "leave out --take, or take a number of the table";
    four_bars_have_defects(found) = "{found} four-bars pass all positions, but none of them passes the positions in one assembly mode and in the given order";
    TAKE_ONE_NEVERTHELESS = "change a position or the order; --take 1 shows the table, and takes the first four-bar nevertheless";
    // cli/synthesize/proven.rs
    the_scenario_is_not_proven(reason) = "NOT PROVEN: {reason}";
    // cli/synthesize/search.rs
    found_by(command, report) = "Found by: {command}\n{report}";
    linkproof_synthesize_search_seed_candidates(args, seed, candidates, refined, evaluations) = "linkproof synthesize search {args} --seed {seed} --candidates {candidates} --refined {refined} --evaluations {evaluations}";
    is_no_varied_limit(text, most) = "expected NAME=FROM:TO:COUNT with 2 to {most} points, such as acceleration_m_s2=130:200:8, found \"{text}\"";
    the_methods_are(names) = "the methods are: {names}";
    // cli/synthesize/target.rs
    NAME_ANOTHER_FILE = "name another file";
    the_scenario_found_would_overwrite(source) = "the new scenario would overwrite {source}, from which it is made";
    // cli/view.rs
    layout_plotjuggler_file_file_being(to) = "layout     {to}\nplotjuggler -l FILE, with the layout above as FILE: the layout loads the recording.\n";
    layout_open_in_foxglove_or_lichtblick(to, args) = "layout     {to}\n1. Open {args} in Foxglove or Lichtblick (open local file).\n2. Choose Layouts > Import from file, and open the layout above. The mechanism then moves beside its plots.\n";
    OPEN_THE_FILE_FROM_RERUN = "open the file in Rerun; the file contains the whole scene";
    rerun_viewer_has_not_shown(to, found) = "Rerun's viewer did not show {to}: {found}";
    PYTHON3_PIP_INSTALL_RERUN_SDK = "`python3 -m pip install rerun-sdk`, or use --python to name a Python installation that has rerun-sdk";
    cannot_be_written_by(to, python, found) = "{to} cannot be written by `{python}`: {found}";
    // cli/exercise.rs
    EXPECTED_A_SHARE_SUCH_AS = "expected a fraction below 1, such as 5% or 0.05, or `digits`";
    expected_one_of(words) = "expected {words}";
    EXPECTED_AT_MOST_50_PER_CENT = "expected at most 50 per cent";
    EXPECTED_AN_ANGLE_BELOW_90 = "expected an angle below 90 deg";
    sheets_are_in(count, directory, quoted) = "{count} sheets are in {directory}: give out tasks/ and answers/, keep teacher/.\nnext: linkproof mark {quoted}\n";
    holds_the_sheets_of_another_class(directory, sheet) = "{directory} contains another class, which has the sheet {sheet}";
    NAME_ANOTHER_DIRECTORY_FOR_THE_CLASS = "name another directory with -o, or remove the old sheets";
    GIVE_EVERY_SCENARIO_A_NAME = "give every scenario a unique name, or leave one of the two out";
    // cli/mark.rs
    NAME_THE_DIRECTORY_OF_THE_EXERCISE = "name the directory that `linkproof exercise` has written, or tables of answers in its directory `answers`";
    there_is_no_key_of_a_class(path, key) = "{path} does not belong to an exercise: there is no {key}";
    a_directory_and_other_paths(directory) = "{directory} is the directory of a whole class, but further paths are given";
    is_no_sheet_of_this_class(path, key) = "{key} has no sheet with the name of {path}";
    its_sheets_are(names) = "the first sheets of this class are {names}";
    // cli/sweep.rs
    the_proof_of_a_case_disagrees(case, file, sets) =
        "case {case}: the proof disagrees. The sweep has stopped; its finished parts are stored.\n\
         Repeat the proof of this case: linkproof run {file}{sets}";
    is_varied_and_set(key) = "`{key}` is varied and has a fixed value too";
    VARY_OR_SET = "leave out one of the two";
    repeat_a_case(file, sets) = "next  linkproof run {file}{sets}";
    // cli/bearings.rs
    BEARINGS_OF_A_FREE_MOTION = "the motion is free: these are the loads of the nominal motion, which may be smaller than those of the free motion; `linkproof run FILE` lists the largest forces of the free motion";
    DIAGRAM_OF_A_FREE_MOTION = "the motion is free: the diagram shows the nominal motion";
    // cli/golden.rs
    is_no_mechanism_of_the_set(name) = "{name} is not a mechanism of the set";
    the_set_has(names) = "the set has {names}";
    has_the_verdict(name, verdict) = "{name} is not proven: the verdict is {verdict}";
    NAME_A_NEW_DIRECTORY_FOR_THE_SET = "name a new directory with -o DIR; only an equal set is replaced";
    mechanisms_are_in(count, directory) = "{count} mechanisms in {directory}; README.md there has the conventions\n";
}
