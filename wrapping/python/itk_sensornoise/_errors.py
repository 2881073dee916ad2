# ==========================================================================
#
#   Copyright the ITKSensorNoise contributors
#
#   Licensed under the Apache License, Version 2.0 (the "License");
#   you may not use this file except in compliance with the License.
#   You may obtain a copy of the License at
#
#          https://www.apache.org/licenses/LICENSE-2.0.txt
#
#   Unless required by applicable law or agreed to in writing, software
#   distributed under the License is distributed on an "AS IS" BASIS,
#   WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
#   See the License for the specific language governing permissions and
#   limitations under the License.
#
# ==========================================================================*/
"""What ITK throws, in words for people."""

from collections.abc import Iterator
from contextlib import contextmanager


def cause_of(error: BaseException) -> str:
    """The sentence in an ITK exception, on one line, without the file, class and address that stand before it."""
    text = str(error)
    start = text.find("): ", max(text.find("ITK ERROR: "), 0))
    sentence = text[start + 3 :] if start >= 0 else text
    return " ".join(sentence.split())


@contextmanager
def itk_errors(context: str = "", kind: type[Exception] = RuntimeError) -> Iterator[None]:
    """Raises what ITK throws as `kind`: first line the cause, after `context`, then ITK's whole text."""
    try:
        yield
    except (RuntimeError, TypeError, OverflowError) as error:
        raise kind(f"{context}{cause_of(error)}\n{error}") from error
