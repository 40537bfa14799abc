#include "geometry/reader/document_parts.h"

#include <Quantity_Color.hxx>
#include <TColStd_HSequenceOfExtendedString.hxx>
#include <TCollection_AsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/import/part_names.h"
#include "geometry/import/text_encoding.h"

namespace st::occt {
namespace {

std::string name_of(const TDF_Label& label) {
  Handle(TDataStd_Name) attribute;
  if (label.IsNull() || !label.FindAttribute(TDataStd_Name::GetID(), attribute)) return {};
  const TCollection_ExtendedString wide = attribute->Get();
  std::vector<char> utf8(static_cast<std::size_t>(wide.LengthOfCString()) + 1, '\0');
  Standard_PCharacter out = utf8.data();
  wide.ToUTF8CString(out);
  const std::string text = valid_utf8(utf8.data());
  return is_junk(text) ? std::string() : text;
}

std::int32_t rgb(const Quantity_Color& c) {
  double r, g, b;
  c.Values(r, g, b, Quantity_TOC_sRGB);
  const auto byte = [](double x) {
    return static_cast<std::int32_t>(std::lround(255 * std::min(1.0, std::max(0.0, x))));
  };
  return byte(r) << 16 | byte(g) << 8 | byte(b);
}

/// Colours, layers and names of one document, inherited face <- shell/solid <- part.
class DocumentReader {
 public:
  explicit DocumentReader(const Handle(TDocStd_Document) & document)
      : shapes_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
        colors_(XCAFDoc_DocumentTool::ColorTool(document->Main())),
        layers_(XCAFDoc_DocumentTool::LayerTool(document->Main())) {}

  std::vector<CadPart> parts() {
    std::vector<CadPart> result;
    TDF_LabelSequence free;
    shapes_->GetFreeShapes(free);
    visit_all(free, TopLoc_Location(), {}, "", result);
    for (CadPart& part : result)
      if (part.name.empty()) part.path.clear();
    return result;
  }

 private:
  struct Style {
    std::int32_t color = -1;
    std::string layer, name;
  };

  Style style_of(const TDF_Label& label, Style inherited) {
    Quantity_Color color;
    if (colors_->GetColor(label, XCAFDoc_ColorSurf, color) || colors_->GetColor(label, XCAFDoc_ColorGen, color))
      inherited.color = rgb(color);
    Handle(TColStd_HSequenceOfExtendedString) names;
    if (layers_->GetLayers(label, names) && !names.IsNull() && names->Length() > 0)
      inherited.layer = TCollection_AsciiString(names->Value(1)).ToCString();
    if (std::string name = name_of(label); !name.empty()) inherited.name = name;
    return inherited;
  }

  /// Name of what a label stands for: of the product, else of the instance.
  std::string product_name(const TDF_Label& label) const {
    TDF_Label product;
    std::string name;
    if (XCAFDoc_ShapeTool::IsReference(label) && XCAFDoc_ShapeTool::GetReferredShape(label, product))
      name = name_of(product);
    return name.empty() ? name_of(label) : name;
  }

  std::vector<std::string> sibling_names(const TDF_LabelSequence& labels) const {
    std::vector<std::string> names;
    for (int i = 1; i <= labels.Length(); ++i) names.push_back(product_name(labels.Value(i)));
    return numbered_names(std::move(names));
  }

  void visit_all(const TDF_LabelSequence& labels, const TopLoc_Location& location, const Style& inherited,
                 const std::string& path, std::vector<CadPart>& result) {
    const std::vector<std::string> names = sibling_names(labels);
    for (int i = 1; i <= labels.Length(); ++i) visit(labels.Value(i), location, inherited, path + names[i - 1], result);
  }

  void visit(const TDF_Label& label, const TopLoc_Location& location, const Style& inherited, const std::string& path,
             std::vector<CadPart>& result) {
    Style style = style_of(label, inherited);
    TDF_Label target = label;
    TopLoc_Location place = location;
    if (XCAFDoc_ShapeTool::IsReference(label)) {
      XCAFDoc_ShapeTool::GetReferredShape(label, target);
      place = location * XCAFDoc_ShapeTool::GetLocation(label);
      Style own = style_of(target, Style());
      if (style.color < 0) style.color = own.color;
      if (style.layer.empty()) style.layer = own.layer;
      if (!own.name.empty()) style.name = own.name;
    }
    if (XCAFDoc_ShapeTool::IsAssembly(target)) {
      TDF_LabelSequence children;
      XCAFDoc_ShapeTool::GetComponents(target, children);
      visit_all(children, place, style, path + "/", result);
      return;
    }
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(target);
    if (shape.IsNull()) return;
    result.push_back(leaf(target, shape, place, style));
    result.back().path = path;
  }

  CadPart leaf(const TDF_Label& label, const TopoDS_Shape& shape, const TopLoc_Location& place, const Style& style) {
    CadPart part;
    part.shape = shape.Moved(place);
    part.name = style.name;
    // sub-shape styles: solids and shells first, faces override
    struct Sub {
      TopTools_IndexedMapOfShape members;
      Style style;
    };
    std::vector<Sub> subs;
    for (const auto kind : {TopAbs_SOLID, TopAbs_SHELL}) {
      TopTools_IndexedMapOfShape map;
      TopExp::MapShapes(shape, kind, map);
      for (int i = 1; i <= map.Extent(); ++i) {
        TDF_Label sub;
        if (!shapes_->FindSubShape(label, map(i), sub)) continue;
        subs.emplace_back();
        subs.back().style = style_of(sub, Style());
        TopExp::MapShapes(map(i), TopAbs_FACE, subs.back().members);
      }
    }
    TopTools_IndexedMapOfShape faces, edges;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    for (int i = 1; i <= faces.Extent(); ++i) {
      Style s;
      s.color = style.color;
      s.layer = style.layer;
      for (const Sub& sub : subs)
        if (sub.members.Contains(faces(i))) {
          if (sub.style.color >= 0) s.color = sub.style.color;
          if (!sub.style.layer.empty()) s.layer = sub.style.layer;
        }
      TDF_Label sub;
      if (shapes_->FindSubShape(label, faces(i), sub)) s = style_of(sub, s);
      part.faces.push_back({faces(i).Moved(place), s.name, s.layer, s.color});
    }
    name_bodies(
        shape,
        [&](const TopoDS_Shape& solid) {
          TDF_Label sub;
          return shapes_->FindSubShape(label, solid, sub) ? name_of(sub) : std::string();
        },
        part);
    TopExp::MapShapes(shape, TopAbs_EDGE, edges);
    for (int i = 1; i <= edges.Extent(); ++i) {
      TDF_Label sub;
      if (!shapes_->FindSubShape(label, edges(i), sub)) continue;
      if (std::string name = name_of(sub); !name.empty()) part.edges.push_back({edges(i).Moved(place), name});
    }
    return part;
  }

  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_ColorTool) colors_;
  Handle(XCAFDoc_LayerTool) layers_;
};

}  // namespace

Handle(TDocStd_Document) new_document() {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  return document;
}

void close_document(const Handle(TDocStd_Document) & document) {
  XCAFApp_Application::GetApplication()->Close(document);
}

std::vector<CadPart> document_parts(const Handle(TDocStd_Document) & document) {
  return DocumentReader(document).parts();
}

}  // namespace st::occt
