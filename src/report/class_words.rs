//! The sentences of task sheets, answer sheets and marks: one row for each sentence, in all languages.

linkage::words! {
    /// Language of sheets and marks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub(crate) enum SheetLanguage: code {
        /// English.
        English = "en",
        /// Ukrainian.
        Ukrainian = "uk",
    }
}

/// Declares sentences in two languages. A row has the form `name(values) = "English" | "Ukrainian";`.
macro_rules! in_both {
    ($($name:ident $(($($value:ident),+))? = $english:literal | $ukrainian:literal;)*) => {$(
        pub(super) fn $name(language: SheetLanguage $($(, $value: &dyn std::fmt::Display)+)?) -> String {
            match language {
                SheetLanguage::English => format!($english),
                SheetLanguage::Ukrainian => format!($ukrainian),
            }
        }
    )*};
}

in_both! {
    // Task sheet
    task_of(name) = "Task {name}" | "Завдання {name}";
    student_and_group = "Name, group, date:" | "Прізвище, група, дата:";
    given = "Given" | "Дано";
    asked = "Find" | "Знайти";
    answers = "Answers" | "Відповіді";
    the_mechanism_at(at) = "The mechanism at the crank angle {at} deg, in the configuration that it keeps."
        | "Механізм при куті повороту кривошипа {at}°; таке складання зберігається під час руху.";
    crank_speed(link, speed) = "Angular velocity of the crank ({link}): {speed}, constant; counter-clockwise positive."
        | "Кутова швидкість кривошипа ({link}): {speed}, стала; додатний напрям — проти годинникової стрілки.";
    drive_speed(link, speed) = "Speed of the driving link ({link}): {speed}, constant."
        | "Швидкість ведучої ланки ({link}): {speed}, стала.";
    frame_of_angles = "Angles are counter-clockwise from the x axis of the frame; the angle of a link is that of its x axis."
        | "Кути відраховують проти годинникової стрілки від осі x стояка; кут ланки — це кут її осі x.";
    points_of_the_ground = "Frame, coordinates in mm" | "Стояк, координати в мм";
    points_of(link, number) = "Link {link} ({number} in the drawing), coordinates in its own axes, mm"
        | "Ланка {link} (на рисунку {number}), координати у власних осях, мм";
    distances = "lengths, mm" | "довжини, мм";
    guide(joint, degrees) = "Guide {joint}: direction {degrees} deg" | "Напрямна {joint}: напрям {degrees}°";
    mass_of(mass, inertia, x, y) = "mass {mass} kg, moment of inertia about the mass centre {inertia} kg m², mass centre ({x}; {y}) mm"
        | "маса {mass} кг, момент інерції відносно центра мас {inertia} кг·м², центр мас ({x}; {y}) мм";
    gravity(x, y) = "Acceleration of gravity: ({x}; {y}) m/s²" | "Прискорення вільного падіння: ({x}; {y}) м/с²";
    transmissions_as_in_the_file = "Transmissions, as in the scenario file" | "Передачі, як у файлі сценарію";
    loads_as_in_the_file = "Loads, as in the scenario file" | "Навантаження, як у файлі сценарію";
    at_the_positions(unit) = "The quantities in the table, at the crank positions (in {unit}) in the head of the table."
        | "Величини таблиці для положень кривошипа ({unit}), указаних у її заголовку.";
    the_given_pose_is_near_singular(at) = "At {at} deg a transmission angle is small, so this sheet uses another pose instead."
        | "У положенні {at}° кут передачі малий, тому замість нього взято інше положення.";
    decimals = "decimals" | "знаків після коми";
    quantity = "quantity" | "величина";
    unit_word = "unit" | "одиниця";
    fill_in(file) = "Write the answers into this table and into the file {file}. Leave a cell empty if you have no answer."
        | "Відповіді запишіть у цю таблицю та у файл {file}. Якщо відповіді немає, залиште клітинку порожньою.";
    answers_to_all_sheets = "Answers to all sheets" | "Відповіді до всіх завдань";
    for_the_teacher = "For the teacher." | "Для викладача.";
    numbers_of_the_sheet(seed) = "Numbers drawn with the seed {seed}." | "Числа отримано з початковим числом {seed}.";
    // Quantities
    angle_of(name) = "angle of rotation of {name}, φ" | "кут повороту ланки {name}, φ";
    omega_of(name) = "angular velocity of {name}, ω" | "кутова швидкість ланки {name}, ω";
    alpha_of(name) = "angular acceleration of {name}, ε" | "кутове прискорення ланки {name}, ε";
    speed_of(name) = "velocity of point {name}, magnitude v" | "швидкість точки {name}, модуль v";
    acceleration_of(name) = "acceleration of point {name}, magnitude a" | "прискорення точки {name}, модуль a";
    reaction_of(name) = "reaction in joint {name}, magnitude R" | "реакція в кінематичній парі {name}, модуль R";
    balancing_moment = "balancing moment on the crank, M" | "зрівноважувальний момент на кривошипі, M";
    other_quantity(name) = "{name}" | "{name}";
    // Criterion
    right_within(percent) = "An answer is right if it differs from the right value by at most {percent} % of this value, or half a unit of the last requested decimal if that is more; an angle, by at most {percent} % of a radian."
        | "Відповідь правильна, якщо вона відрізняється від правильного значення не більш ніж на {percent} % цього значення або на половину одиниці останнього потрібного знака, якщо це більше; кут — не більш ніж на {percent} % радіана.";
    right_to_digits = "An answer is right if it differs from the right value by at most half a unit of the last requested decimal."
        | "Відповідь правильна, якщо вона відрізняється від правильного значення не більш ніж на половину одиниці останнього потрібного знака.";
    right_as_written = "An answer is right if it differs from the right value by at most half a unit of the last digit written, and by at most half a unit of the last requested decimal."
        | "Відповідь правильна з точністю до половини одиниці останнього записаного знака, але не грубіше за останній потрібний знак.";
    // Marks
    marks_of_the_class = "Marks of the class" | "Оцінки групи";
    marks_of(name) = "Marks of {name}" | "Перевірка {name}";
    student = "student" | "студент";
    right_cells = "right" | "правильно";
    wrong_cells = "wrong" | "неправильно";
    open_cells = "no answer" | "без відповіді";
    percent_right = "mark, %" | "оцінка, %";
    causes = "causes" | "причини";
    cause = "cause" | "причина";
    position = "position" | "положення";
    answer = "answer" | "відповідь";
    right_value = "right value" | "правильне значення";
    not_handed_in = "not handed in" | "не здано";
    no_cause_recognised = "no cause recognised" | "причину не розпізнано";
    right_of_cells(right, count, percent) = "{right} of {count} cells are right: {percent} %." | "Правильних клітинок: {right} із {count}, тобто {percent} %.";
    legend = "✓ right, ✗ wrong, – no answer" | "✓ правильно, ✗ неправильно, – немає відповіді";
    // Causes
    opposite_sign = "opposite sign" | "протилежний знак";
    unit_for(written, asked) = "{written} instead of {asked}" | "{written} замість {asked}";
    point_moved(power) = "decimal point moved: times 10^{power}" | "зсунуто кому: множник 10^{power}";
    twice = "twice the value" | "подвоєне значення";
    half = "half the value" | "половина значення";
    zero = "zero instead of the value" | "нуль замість значення";
    per_radian = "analogue (derivative by the crank angle) instead of the derivative by time" | "аналог (на радіан кривошипа) замість величини за секунду";
    supplement = "supplementary angle: 180° minus the right angle" | "суміжний кут: 180° мінус правильний";
    other_end = "180° too large: direction from the other end of the link" | "більше на 180°: напрям від іншого кінця ланки";
    complement = "complementary angle: 90° minus the right angle" | "доповняльний кут: 90° мінус правильний";
    from_vertical = "90° off: measured from the vertical" | "різниця 90°: відлік від вертикалі";
    relative_angle(link) = "angle relative to {link}" | "кут відносно ланки {link}";
    exchanged_with(cell) = "exchanged with {cell}" | "переставлено з {cell}";
    value_of(cell) = "value of {cell}" | "значення для {cell}";
    opposite_of(cell) = "value of {cell} with the opposite sign" | "значення для {cell} з протилежним знаком";
    digits_swapped = "two digits exchanged" | "переставлено дві цифри";
    one_digit = "one digit wrong" | "одна цифра неправильна";
    digit_lost = "one digit left out or added" | "пропущено або зайва цифра";
    without_carried(point, other) = "{point} only relative to {other}: the part of {other} is missing" | "лише відносно {other}: для {point} не додано складову точки {other}";
    without_normal(point, other) = "normal part of {point} about {other} forgotten" | "забуто нормальну складову {point} відносно {other}";
    without_tangential(point, other) = "tangential part of {point} about {other} forgotten" | "забуто тангенціальну складову {point} відносно {other}";
    from_whole_speed(point) = "from the whole velocity of {point} instead of its relative velocity" | "за повною швидкістю {point} замість відносної";
    no_normal(link) = "normal acceleration of {link} forgotten" | "забуто нормальне прискорення ланки {link}";
    no_normals = "all normal accelerations forgotten" | "забуто всі нормальні прискорення";
    no_coriolis(joint) = "Coriolis acceleration in {joint} forgotten" | "забуто прискорення Коріоліса в парі {joint}";
    configuration(group, mode) = "another assembly mode of {group}: {mode}" | "інше складання групи {group}: {mode}";
    reversed = "crank turned in the opposite sense" | "кривошип обертається у протилежний бік";
    speed_unit(written, asked) = "speed of the crank taken in {written} instead of {asked}" | "швидкість кривошипа взято в {written} замість {asked}";
    clockwise = "crank angle measured clockwise" | "кут кривошипа відкладено за годинниковою стрілкою";
    crank_turned(degrees) = "crank angle off by {degrees}°" | "кут кривошипа зміщено на {degrees}°";
    no_gravity = "weights forgotten" | "забуто сили ваги";
    gravity_up = "weights act upwards" | "сили ваги спрямовано вгору";
    no_inertia = "inertia forces forgotten" | "забуто сили інерції";
    no_load(number) = "load {number} forgotten" | "забуто навантаження {number}";
    from_other_end(link, point) = "{point} measured from the other end of {link}" | "точку {point} відкладено від іншого кінця ланки {link}";
    of_student(name) = "answers of {name}" | "відповіді {name}";
}

/// Symbols of units: English, Ukrainian.
const UNITS: [(&str, &str); 25] = [
    ("deg", "°"),
    ("rad", "рад"),
    ("rad/s", "рад/с"),
    ("deg/s", "°/с"),
    ("rpm", "об/хв"),
    ("rad/s^2", "рад/с²"),
    ("deg/s^2", "°/с²"),
    ("m", "м"),
    ("mm", "мм"),
    ("cm", "см"),
    ("m/s", "м/с"),
    ("mm/s", "мм/с"),
    ("cm/s", "см/с"),
    ("km/h", "км/год"),
    ("m/s^2", "м/с²"),
    ("mm/s^2", "мм/с²"),
    ("cm/s^2", "см/с²"),
    ("N", "Н"),
    ("kN", "кН"),
    ("kgf", "кгс"),
    ("N m", "Н·м"),
    ("N mm", "Н·мм"),
    ("N cm", "Н·см"),
    ("kN m", "кН·м"),
    ("kgf m", "кгс·м"),
];

/// The symbol of a unit in a language. A unit without a row in `UNITS` keeps its symbol, but with `²` for `^2`.
pub(super) fn unit(language: SheetLanguage, symbol: &str) -> String {
    let own = UNITS.iter().find(|(english, _)| *english == symbol);
    match (language, own) {
        (SheetLanguage::Ukrainian, Some((_, ukrainian))) => (*ukrainian).into(),
        (SheetLanguage::English, _) | (SheetLanguage::Ukrainian, None) => symbol.replace("^2", "²"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_has_one_row() {
        let all = [SheetLanguage::English, SheetLanguage::Ukrainian].map(|language| unit(language, "rad/s^2"));
        assert_eq!(all, ["rad/s²", "рад/с²"]);
        assert!(UNITS.iter().enumerate().all(|(at, one)| UNITS[at + 1..].iter().all(|other| one.0 != other.0)));
    }
}
