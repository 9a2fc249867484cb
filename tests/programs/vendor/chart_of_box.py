#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A program in CFC as TwinCAT stores it, with one box whose pins have no names.  usage: chart_of_box.py NAME TYPE VARIABLE..."""
import sys
from xml.sax.saxutils import escape

box, kind, pins = sys.argv[1], sys.argv[2], sys.argv[3:]
pin = lambda n: '<o><v n="Negated">false</v><v n="Id">%dL</v></o>' % n
text = lambda t: '<o><v n="Text">"%s"</v></o>' % escape(t)
items = ''.join('<o t="CFCInputElement"><o n="Output" t="CFCOutputPin"><v n="Negated">false</v><v n="Id">%dL</v></o><o n="Text" t="CFCText"><v n="Text">"%s"</v></o></o>\n' % (11 + i, escape(p)) for i, p in enumerate(pins))
items += ('<o t="CFCBoxElement"><o n="Inputs"><l2 n="InnerList" cet="CFCInputPin">%s</l2></o><o n="Outputs"><l2 n="InnerList" cet="CFCOutputPin">%s</l2></o><o n="Texts"><l2 n="InnerList" cet="CFCText">%s</l2></o><v n="KindOfCall" t="KindOfCall">Operator</v></o>\n'
          % (''.join(pin(31 + i) for i in range(len(pins))), pin(50), text('') * (len(pins) + 1) + text(box)))
items += '<o t="CFCOutputElement"><o n="Input" t="CFCInputPin"><v n="Negated">false</v><v n="Id">51L</v></o><o n="Text" t="CFCText"><v n="Text">"r"</v></o></o>\n'
items += ''.join('<o t="CFCConnection"><v n="SourcePinId">%dL</v><v n="DestPinId">%dL</v></o>\n' % w for w in [(11 + i, 31 + i) for i in range(len(pins))] + [(50, 51)])
print('<TcPlcObject><POU Name="Main"><Declaration>PROGRAM Main\nVAR r : %s; END_VAR</Declaration><Implementation><CFC><XmlArchive><Data>\n<o t="CFCImplementationObject"><o n="Items"><l2 n="InnerList">\n%s</l2></o></o></Data></XmlArchive></CFC></Implementation></POU></TcPlcObject>' % (kind, items))
