# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The evaluation of a camera by EMVA Standard 1288: a mapping that prints and is written as JSON and XML."""

import html
from typing import Any, overload

from ._pictures import pack, unpack, write_page
from ._quantity import Quantity
from ._record import Record
from ._types import FileName, ItkObject

# Members of the record that hold quantities.
_SECTIONS = ("sensitivity", "linearity", "dark_current", "spatial", "comparison")


class Emva1288Report(Record):
    """The evaluation of one camera: the record "itk-sensornoise-emva1288/1", the same names as in its JSON.

        report.gain.value, report.gain.standard_error     system gain K of the standard
        report.quantity("spatial.dsnu_column")            any quantity, by section and name
        report["points"]                                  the photon transfer curve, a dict for each exposure
        report["notes"]                                   what the recording lacks

    documentation/reference/emva1288.md lists all members. print() shows the table of `estimate-sensor-noise --method
    emva1288`. It is a dict that cannot be changed: to_dict() gives a copy that can. It can be pickled.

    See Also
    --------
    evaluate_emva1288 : Makes it.
    """

    def __init__(self, text: str, table: str, xml: str, page: bytes) -> None:
        """`text`: the record as JSON. `table`: its table as text. `xml`: the results in the format of the package
        emva1288. `page`: the same as HTML, packed."""
        super().__init__(text)
        self._table = table
        self._xml = xml
        self._page = page

    @classmethod
    def of(cls, evaluator: ItkObject) -> "Emva1288Report":
        """Returns the report of an itk.Emva1288Evaluator after Evaluate()."""
        texts = (evaluator.GetReportAsJson(), evaluator.GetReportAsText(), evaluator.GetReportAsXml())
        return cls(*texts, pack(evaluator.GetReportAsHtml()))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._text, self._table, self._xml, self._page)

    def __str__(self) -> str:
        return self._table.rstrip("\n")

    def __repr__(self) -> str:
        return f"<Emva1288Report: {len(self['points'])} exposures, gain {self.gain}>"

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(str(self))}</pre>"

    def quantity(self, path: str) -> Quantity:
        """Returns the quantity at a path, section and name as "spatial.prnu". Raises KeyError for another path."""
        section, _, name = path.partition(".")
        if section not in _SECTIONS or name not in self[section]:
            raise KeyError(f"{path!r} is no quantity of the report; the rows of quantities() name them")
        return Quantity.of(self[section][name])

    def quantities(self) -> list[dict[str, Any]]:
        """Returns every quantity as a row: `path`, `value`, `standard_error`, `interval95`, `status`, `unit`."""
        names = ("value", "standard_error", "interval95", "status", "unit")
        return [
            {"path": f"{section}.{name}", **{key: quantity[key] for key in names}}
            for section in _SECTIONS
            for name, quantity in self[section].items()
        ]

    @property
    def gain(self) -> Quantity:
        """System gain K of the standard's fit [DN/e-]."""
        return self.quantity("sensitivity.gain")

    @property
    def weighted_gain(self) -> Quantity:
        """Slope of the weighted line of variance against mean [DN/e-]: the gain with the smaller error."""
        return self.quantity("sensitivity.weighted_gain")

    @property
    def dark_noise(self) -> Quantity:
        """Temporal dark noise sigma_d [e-], without quantization noise."""
        return self.quantity("sensitivity.dark_noise")

    @property
    def linearity_error(self) -> Quantity:
        """Linearity error LE [%]."""
        return self.quantity("linearity.linearity_error")

    @property
    def dsnu(self) -> Quantity:
        """Dark signal non-uniformity DSNU1288 [e-], after the highpass filter."""
        return self.quantity("spatial.dsnu")

    @property
    def prnu(self) -> Quantity:
        """Photo response non-uniformity PRNU1288 [%], after the highpass filter."""
        return self.quantity("spatial.prnu")

    def to_xml(self) -> str:
        """Returns the evaluation as XML with the names and units of the package emva1288, version 1.0.2."""
        return self._xml

    @overload
    def to_html(self, path: FileName, *, title: str | None = None) -> None: ...

    @overload
    def to_html(self, path: None = None, *, title: str | None = None) -> str: ...

    def to_html(self, path: FileName | None = None, *, title: str | None = None) -> str | None:
        """Makes the page that `estimate-sensor-noise --method emva1288 --plot page.html` writes: the main results, the
        photon transfer curve, all quantities, the signal-to-noise ratio, the linearity, and all exposures.

        `path` ends in .html or .htm; without it the text of the page is returned. `title` is the title and the first
        heading. Raises TypeError, ValueError and OSError as Report.to_html().
        """
        return write_page(unpack(self._page), path, title)
