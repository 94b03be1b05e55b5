//! Tables with named columns, which NumPy and data frames use without a copy.

use std::sync::Arc;

use arrow_array::{Array, ArrayRef, Float64Array, Int64Array, StringArray, StructArray};
use arrow_buffer::{Buffer, ScalarBuffer};
use arrow_schema::{ArrowError, DataType, Field, Fields};
use linkproof::parts::Error;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyList};
use pyo3_arrow::buffer::PyArrowBuffer;
use pyo3_arrow::ffi::{ArrayIterator, to_stream_pycapsule};

use crate::{html, sentences};

/// Key of a column's unit in Arrow's metadata.
const UNIT: &str = "unit";
/// Number of rows that a notebook shows.
const SHOWN: usize = 12;

/// One column before it becomes part of a table.
pub(crate) struct TableColumn {
    name: String,
    unit: String,
    array: ArrayRef,
    has_gaps: bool,
}

impl TableColumn {
    fn of(name: impl Into<String>, unit: &str, array: impl Array + 'static, has_gaps: bool) -> TableColumn {
        TableColumn { name: name.into(), unit: unit.into(), array: Arc::new(array), has_gaps }
    }

    /// Numbers in `unit`. The vector becomes the column without a copy.
    pub(crate) fn numbers(name: impl Into<String>, unit: &str, values: Vec<f64>) -> TableColumn {
        TableColumn::of(name, unit, Float64Array::new(ScalarBuffer::from(values), None), false)
    }

    /// Numbers in `unit`; `None` for a missing number.
    pub(crate) fn perhaps(name: impl Into<String>, unit: &str, values: Vec<Option<f64>>) -> TableColumn {
        TableColumn::of(name, unit, Float64Array::from(values), true)
    }

    /// Whole numbers.
    pub(crate) fn whole(name: impl Into<String>, values: Vec<i64>) -> TableColumn {
        TableColumn::of(name, "", Int64Array::from(values), false)
    }

    /// Whole numbers; `None` for a missing number.
    pub(crate) fn perhaps_whole(name: impl Into<String>, values: Vec<Option<i64>>) -> TableColumn {
        TableColumn::of(name, "", Int64Array::from(values), true)
    }

    /// Texts.
    pub(crate) fn texts(name: impl Into<String>, values: Vec<String>) -> TableColumn {
        TableColumn::of(name, "", StringArray::from(values), false)
    }

    /// Texts; `None` for a missing text.
    pub(crate) fn perhaps_texts(name: impl Into<String>, values: Vec<Option<String>>) -> TableColumn {
        TableColumn::of(name, "", StringArray::from(values), true)
    }
}

/// Named columns of equal length: a mapping from names to columns.
///
/// A column of numbers is a read-only NumPy array of float64 (int64 for whole numbers). The array shares the memory of
/// the table.
/// A column of texts is a list. Data frames read the table through `__arrow_c_stream__`.
#[pyclass(module = "linkproof", subclass, frozen)]
pub(crate) struct Table {
    columns: StructArray,
}

impl Table {
    pub(crate) fn of(columns: Vec<TableColumn>) -> Table {
        let field = |column: &TableColumn| {
            let field = Field::new(&column.name, column.array.data_type().clone(), column.has_gaps);
            match column.unit.as_str() {
                "" => field,
                unit => field.with_metadata([(UNIT.into(), unit.into())].into()),
            }
        };
        let fields: Fields = columns.iter().map(field).collect();
        let arrays = columns.into_iter().map(|column| column.array).collect();
        Table { columns: StructArray::new(fields, arrays, None) }
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.fields().iter().map(|field| field.name().as_str())
    }

    /// The column with this index, as a Python object.
    fn column<'py>(&self, py: Python<'py>, index: usize) -> PyResult<Bound<'py, PyAny>> {
        let array = self.columns.column(index);
        if let Some(numbers) = array.as_any().downcast_ref::<Float64Array>() {
            return match numbers.null_count() {
                0 => shared(py, numbers.values().inner().clone(), "=f8"),
                _ => with_gaps(py, numbers.iter()),
            };
        }
        if let Some(numbers) = array.as_any().downcast_ref::<Int64Array>() {
            return match numbers.null_count() {
                0 => shared(py, numbers.values().inner().clone(), "=i8"),
                _ => with_gaps(py, numbers.iter().map(|value| value.map(|value| value as f64))),
            };
        }
        let texts = array.as_any().downcast_ref::<StringArray>().expect("columns are numbers or texts");
        Ok(PyList::new(py, texts.iter())?.into_any())
    }

    /// The first rows as HTML.
    pub(crate) fn html(&self) -> String {
        let rows = (0..self.columns.len().min(SHOWN)).map(|row| {
            let cell = |array: &ArrayRef| -> String {
                let numbers = array.as_any().downcast_ref::<Float64Array>();
                let whole = array.as_any().downcast_ref::<Int64Array>();
                let texts = array.as_any().downcast_ref::<StringArray>();
                match (numbers, whole, texts) {
                    _ if array.is_null(row) => String::new(),
                    (Some(numbers), ..) => html::number(numbers.value(row)),
                    (_, Some(whole), _) => whole.value(row).to_string(),
                    (.., Some(texts)) => texts.value(row).into(),
                    (None, None, None) => String::new(),
                }
            };
            self.columns.columns().iter().map(cell).collect()
        });
        let mut text = html::table(&self.names().collect::<Vec<_>>(), rows);
        let left = self.columns.len().saturating_sub(SHOWN);
        if left > 0 {
            text += &html::paragraph(&sentences::and_more_rows(&left));
        }
        text
    }
}

/// A NumPy array of numbers. A missing number is NaN.
fn with_gaps<'py>(py: Python<'py>, numbers: impl Iterator<Item = Option<f64>>) -> PyResult<Bound<'py, PyAny>> {
    let whole = numbers.map(|value| value.unwrap_or(f64::NAN));
    shared(py, ScalarBuffer::from_iter(whole).into_inner(), "=f8")
}

/// A NumPy array that shares the memory of an Arrow buffer.
fn shared<'py>(py: Python<'py>, values: Buffer, kind: &str) -> PyResult<Bound<'py, PyAny>> {
    let owner = Bound::new(py, PyArrowBuffer::new(values))?;
    py.import("numpy")?.call_method1("frombuffer", (owner, kind))
}

/// Tables with the same column names and types as one stream of Arrow. `first` gives these names and types; the stream
/// does not contain its rows.
pub(crate) fn streamed<'py>(
    py: Python<'py>,
    first: &Table,
    tables: impl Iterator<Item = Result<Table, Error>> + Send + 'static,
    requested_schema: Option<Bound<'py, PyCapsule>>,
) -> PyResult<Bound<'py, PyCapsule>> {
    let whole = Field::new("", DataType::Struct(first.columns.fields().clone()), false);
    let batches = tables.map(|table| match table {
        Ok(table) => Ok(Arc::new(table.columns) as ArrayRef),
        Err(error) => Err(ArrowError::ComputeError(error.message().into())),
    });
    let stream = ArrayIterator::new(batches, Arc::new(whole));
    Ok(to_stream_pycapsule(py, Box::new(stream), requested_schema)?)
}

#[pymethods]
impl Table {
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        match self.names().position(|own| own == name) {
            Some(index) => self.column(py, index),
            None => {
                let names: Vec<&str> = self.names().collect();
                let near = scenario::words::suggestion(name, names.iter().copied(), "\"");
                Err(PyKeyError::new_err(sentences::there_is_no_column(&name, &near)))
            }
        }
    }

    fn __len__(&self) -> usize {
        self.columns.num_columns()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.keys(py)?.call_method0("__iter__")
    }

    fn __contains__(&self, name: &Bound<'_, PyAny>) -> bool {
        name.extract::<String>().is_ok_and(|name| self.names().any(|own| own == name))
    }

    /// Names of the columns.
    fn keys<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        PyList::new(py, self.names())
    }

    /// The columns.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        (0..self.columns.num_columns()).map(|index| self.column(py, index)).collect()
    }

    /// Pairs of name and column.
    fn items<'py>(&self, py: Python<'py>) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
        Ok(self.names().map(String::from).zip(self.values(py)?).collect())
    }

    /// The column of this name, or `default` if there is no such column.
    #[pyo3(signature = (name, default=None, /))]
    fn get<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        default: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        match self.names().position(|own| own == name) {
            Some(index) => self.column(py, index).map(Some),
            None => Ok(default),
        }
    }

    /// Number of rows.
    #[getter]
    fn rows(&self) -> usize {
        self.columns.len()
    }

    /// Unit of every column of numbers that has one.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let units = PyDict::new(py);
        for field in self.columns.fields() {
            if let Some(unit) = field.metadata().get(UNIT) {
                units.set_item(field.name(), unit)?;
            }
        }
        Ok(units)
    }

    /// The table as a data frame of pandas, which must be installed.
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let columns = PyDict::new(py);
        for (name, column) in self.items(py)? {
            columns.set_item(name, column)?;
        }
        py.import("pandas")?.call_method1("DataFrame", (columns,))
    }

    /// The table as a stream of Arrow.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        streamed(py, self, std::iter::once(Ok(Table { columns: self.columns.clone() })), requested_schema)
    }

    fn __repr__(&self) -> String {
        sentences::a_table_of(&self.columns.len(), &self.columns.num_columns())
    }

    fn _repr_html_(&self) -> String {
        self.html()
    }
}
