//! Exercises of a class: numbers drawn for each student, answer sheets, and marks with the causes of wrong answers.

mod command;
mod mistake;
mod planted;

use std::path::Path;

use design::exercise::{ExerciseMechanism, VariationWish, as_given, positions};
use linkage::case::Grid;
use linkage::solver::Solver;
use prover::mark::{AnswerSheet, CellVerdict, MarkCriterion, StudentAnswers, columns_of, marked, read_answers};
use scenario::Scenario;
use scenario::varied::NumberSort;

use crate::common::shipped;

/// Smallest transmission angle that `linkproof exercise` allows by default (rad).
fn transmission() -> f64 {
    20f64.to_radians()
}

/// A study variant with the right answers at four positions.
fn variant(number: usize) -> (Scenario, AnswerSheet) {
    let scenario = shipped(&format!("variants60/variant_{number:02}.toml"));
    let scenario = as_given(&scenario, &scenario.name).unwrap();
    let found = positions(&scenario, 4, transmission()).unwrap_or_else(|error| panic!("{number}: {error}"));
    let columns = columns_of(&[], &scenario.case).unwrap();
    let sheet = AnswerSheet::of(&scenario.case, columns, &found, 3).unwrap_or_else(|error| panic!("{number}: {error}"));
    (scenario, sheet)
}

/// A table of answers as a student writes it.
/// Right answers have the requested decimals.
/// Other answers have more decimals if they need more for three significant digits.
fn written(sheet: &AnswerSheet, answers: &[Vec<f64>]) -> String {
    let mut text =
        format!("crank_deg,{}\n", sheet.columns.iter().map(|own| own.name.clone()).collect::<Vec<_>>().join(","));
    for (row, values) in answers.iter().enumerate() {
        let cell = |(column, value): (usize, &f64)| {
            let needed = if value.abs() > 1e-9 { 2 - value.abs().log10().floor() as i32 } else { 0 };
            let is_right = *value == sheet.right[row][column];
            let decimals = if is_right { sheet.decimals[column] } else { sheet.decimals[column].max(needed) };
            format!("{value:.*}", decimals as usize)
        };
        let cells: Vec<String> = values.iter().enumerate().map(cell).collect();
        text += &format!("{},{}\n", sheet.positions()[row].to_degrees(), cells.join(","));
    }
    text
}

fn read(sheet: &AnswerSheet, text: &str) -> StudentAnswers {
    read_answers(text, Path::new("answers.csv"), "sheet", sheet).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The right answers, written with the requested digits, have full marks by every criterion.
#[test]
fn sixty_sheets_have_full_marks_against_their_answers() {
    let mut cells = 0;
    for number in 1..=60 {
        let (_, sheet) = variant(number);
        let answers = read(&sheet, &written(&sheet, &sheet.right));
        for criterion in [MarkCriterion::Within(0.05), MarkCriterion::Digits, MarkCriterion::Written] {
            let found = marked(&sheet, &answers, criterion, &[]);
            let count = sheet.right.len() * sheet.columns.len();
            assert_eq!(found.count(CellVerdict::Right), count, "variant {number}, {criterion:?}");
            cells += count;
        }
    }
    println!("60 sheets, {cells} cells right");
}

#[test]
fn drawn_mechanisms_move_like_the_original_and_have_one_solution() {
    let sorts = vec![NumberSort::Lengths, NumberSort::Speed, NumberSort::Masses, NumberSort::Loads];
    let wish = VariationWish { seed: 17, share: 0.2, sorts, transmission: transmission() };
    for name in
        ["crank_rocker", "quick_return", "six_bar_slider", "compressor", "variants60/variant_02", "class3_group"]
    {
        let original = shipped(&format!("{name}.toml"));
        let numbers = original.case.crank().constant_speed().unwrap();
        let mechanism = ExerciseMechanism::of(original, &wish).unwrap_or_else(|error| panic!("{name}: {error}"));
        let mut seen: Vec<String> = Vec::new();
        for student in 0..4 {
            let drawn = mechanism.drawn(&wish, student, "student").unwrap_or_else(|error| panic!("{name}: {error}"));
            let case = &drawn.scenario.case;
            println!("{name} {student}: {} draws, smallest determinant {:.3}", drawn.draws, drawn.determinant);
            let speed = case.crank().constant_speed().unwrap();
            assert!((speed / numbers - 1.0).abs() < 0.21, "{name}: {speed}");
            // Both analytic sides must agree at every tenth instant of the grid.
            let inputs: Vec<f64> = case.grid.inputs.iter().copied().step_by(10).collect();
            let case = case.on(Grid::of_inputs(case.crank(), inputs)).unwrap();
            let [one, other] = [&analytic::AssurSolver as &dyn Solver, &analytic::NewtonSolver]
                .map(|side| side.solve(&case).unwrap_or_else(|error| panic!("{name}: {error}")));
            for (channel, values) in one.iter() {
                let others = other.column(channel).unwrap();
                let size =
                    values.iter().fold(1e-3f64, |most, value| if value.abs() > most { value.abs() } else { most });
                let largest = values
                    .iter()
                    .zip(others)
                    .map(|(a, b)| (a - b).abs())
                    .fold(0.0, |most, gap| if gap > most { gap } else { most });
                assert!(largest <= 1e-8 * size, "{name}, {channel}: {largest:e} of {size:e}");
            }
            assert!(!seen.contains(&drawn.scenario.text), "{name}: two students have the same numbers");
            seen.push(drawn.scenario.text);
        }
    }
}
